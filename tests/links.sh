#!/usr/bin/env bash
# Checks the links of the documents: every relative link and picture in an .md file leads to a file that exists, and every #anchor to a
# heading. Addresses of other machines are not looked up. Prints every breach as file:line.
set -euo pipefail
cd "$(dirname "$0")/.."

failed=0

# breach PLACE WHAT: prints a breach.
breach() {
  failed=1
  printf '%s: %s\n' "$1" "$2"
}

# documents: prints the names of documents that git keeps or could take; without git all but build outputs. Ends every name with a zero
# byte.
documents() {
  if [[ -e .git ]] && git rev-parse --git-dir >/dev/null 2>&1; then
    git ls-files -z --cached --others --exclude-standard -- '*.md'
  else
    find . -mindepth 1 \( -name '.*' -o -path ./build -o -path ./out \) -prune -o -type f -name '*.md' -printf '%P\0'
  fi
}
files=()
while IFS= read -r -d '' file; do
  if [[ -f $file ]]; then files+=("$file"); fi # git also lists removed files
done < <(documents | sort -zu)
if [[ ${#files[@]} -eq 0 ]]; then
  echo "There are no documents."
  exit 1
fi

# Links and headings outside of code: "link FILE LINE TARGET", "heading FILE TEXT" and "anchor FILE NAME", separated by tabs.
found=$(awk '
  function link(target) {
    sub(/^[ \t]+/, "", target)
    if (target ~ /^</) { sub(/^</, "", target); sub(/>.*$/, "", target) } else sub(/[ \t].*$/, "", target)  # without a title
    print "link\t" FILENAME "\t" FNR "\t" target
  }
  function heading(text) { print "heading\t" FILENAME "\t" text }
  FNR == 1 { fence = above = ""; comment = 0 }
  { sub(/\r$/, "") }
  match($0, /^ *(```+|~~~+)/) && !(fence == "" && $0 ~ /^ *```+[^`]*`/) {
    mark = substr($0, RSTART, RLENGTH)
    gsub(/ /, "", mark)
    if (fence == "") fence = mark
    else if (substr(mark, 1, 1) == substr(fence, 1, 1) && length(mark) >= length(fence) && $0 ~ /^ *[`~]+ *$/) fence = ""
    above = ""
    next
  }
  fence != "" { next }
  comment { if (!sub(/^.*-->/, "")) next; comment = 0 }
  { gsub(/<!--([^-]|-[^-])*-->/, "") }
  /<!--/ { sub(/<!--.*$/, ""); comment = 1 }
  /^ ? ? ?#+[ \t]/ { text = $0; sub(/^ *#+[ \t]+/, "", text); sub(/[ \t]+#*[ \t]*$/, "", text); heading(text) }
  /^ ? ? ?(==+|--+)[ \t]*$/ && above != "" { heading(above) }
  { above = $0 ~ /^ *([-*+>|#=]|[0-9]+[.)] )/ ? "" : $0; sub(/^[ \t]+/, "", above); sub(/[ \t]+$/, "", above) }
  {
    rest = $0
    gsub(/``[^`]+(`[^`]+)*``|`[^`]*`/, "code", rest)
    if (match(rest, /^ ? ? ?\[[^]^][^]]*\]:[ \t]*[^ \t]/)) { target = rest; sub(/^[^]]*\]:/, "", target); link(target) }
    for (tags = rest; match(tags, /[ \t](id|name|src|href)="[^"]*"/); tags = substr(tags, RSTART + RLENGTH)) {
      split(substr(tags, RSTART + 1, RLENGTH - 1), part, "\"")
      if (part[1] ~ /^(src|href)/) link(part[2]); else print "anchor\t" FILENAME "\t" part[2]
    }
    for (; match(rest, /\]\(([^()]|\([^()]*\))*\)/); rest = substr(rest, RSTART + RLENGTH)) link(substr(rest, RSTART + 2, RLENGTH - 3))
  }' "${files[@]}")

# Anchors of headings: lower case, without punctuation, blanks as hyphens; of equal ones the second ends with -1.
declare -A anchors=() times=()
while IFS=$'\t' read -r file anchor; do
  before=${times[$file#$anchor]:-0}
  if [[ $before -gt 0 ]]; then anchors[$file#$anchor-$before]=1; else anchors[$file#$anchor]=1; fi
  times[$file#$anchor]=$((before + 1))
done < <(paste <(sed -n 's/^heading\t\([^\t]*\)\t.*/\1/p' <<<"$found") \
  <(sed -n 's/^heading\t[^\t]*\t//p' <<<"$found" | LC_ALL=C.UTF-8 sed -E 's/!?\[([^]]*)\]\([^)]*\)/\1/g;s/<[a-z/][^>]*>//g;s/.*/\L&/;s/[^[:alnum:]_ -]//g;s/ /-/g'))
while IFS=$'\t' read -r file anchor; do
  if [[ -n $file ]]; then anchors[$file#$anchor]=1; fi
done < <(sed -n 's/^anchor\t//p' <<<"$found")

# decoded TEXT: sets `decoded` to TEXT with every %20 as a blank and so on.
decoded() {
  decoded=$1
  if [[ $1 == *%[0-9A-Fa-f][0-9A-Fa-f]* ]]; then printf -v decoded '%b' "${1//%/\\x}"; fi
}

links=0
while IFS=$'\t' read -r file line target; do
  if [[ -z $file || $target =~ ^([A-Za-z][A-Za-z0-9+.-]*:|//) ]]; then continue; fi # nothing, or an address with its scheme
  links=$((links + 1))
  decoded "${target%%#*}"
  case $decoded in
    '') page=$file ;;
    /*) page=.$decoded ;; # from the project's root
    *) page=$(dirname "$file")/$decoded ;;
  esac
  page=$(realpath -ms --relative-to=. -- "$page")
  if [[ -z $target ]]; then
    breach "$file:$line" "a link without a target"
  elif [[ $page == ../* || $page == .. ]]; then
    breach "$file:$line" "$target leads out of the project"
  elif [[ ! -e $page ]]; then
    breach "$file:$line" "$target: there is no $page"
  elif [[ $target == *'#'* && $page == *.md ]]; then
    decoded "${target#*#}"
    [[ -n ${anchors[$page#$decoded]:-} ]] || breach "$file:$line" "$target: $page has no heading of that name"
  fi
done < <(sed -n 's/^link\t//p' <<<"$found")

if [[ $failed -eq 0 ]]; then echo "All $links links of ${#files[@]} documents hold."; fi
exit "$failed"
