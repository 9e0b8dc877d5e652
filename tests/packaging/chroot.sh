#!/usr/bin/env bash
# chroot.sh [PACKAGES]: installs the packages in PACKAGES (out/packages, by tools/package) into a Debian with nothing else, uses them there,
# removes them, and prints the size of their dependencies. Needs root, mmdebstrap, and the network or a mirror that apt knows.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
packages=$(realpath "${1:-$root/out/packages}")
chroot=$(mktemp -d)
trap 'umount "$chroot/proc" "$chroot/dev/pts" 2>/dev/null || true; rm -rf "$chroot"' EXIT
{ cat /etc/apt/sources.list /etc/apt/sources.list.d/*.list /etc/apt/sources.list.d/*.sources 2>/dev/null || true; } |
  mmdebstrap --quiet --variant=apt bookworm "$chroot" -
for file in /etc/apt/apt.conf.d/*proxy* /etc/apt/apt.conf; do [[ -f $file ]] && cp "$file" "$chroot/etc/apt/apt.conf.d/" || true; done
cp -r "$packages" "$chroot/packages"
mount -t proc proc "$chroot/proc"
mount --bind /dev/pts "$chroot/dev/pts"
inside() { chroot "$chroot" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 "$@"; }
used() { inside sh -c "dpkg-query -W -f='\${Installed-Size}\n' | awk '{s += \$1} END {print s}'"; }
install() {
  local before
  before=$(used)
  inside apt-get install -y -qq --no-install-recommends "$@" >"$chroot/apt.log" 2>&1 || { cat "$chroot/apt.log" >&2; exit 1; }
  printf '%s: %s MB more on the disk, %s packages in all\n' "${*##*/}" "$((($(used) - before) / 1000))" "$(inside dpkg-query -W | wc -l)"
}

deb() { for name in "$@"; do (cd "$packages" && printf '/packages/%s\n' "$name"_*.deb); done; }

inside apt-get update -qq
first=$(inside dpkg-query -W -f='${Package}\n' | sort)
install libgl1 fonts-dejavu-core  # every desktop has these
install $(deb dmoscope)
inside dmoscope --version
inside dmoscope smooth /usr/share/dmoscope/samples/coast.14 -o /better.14 --until-converged | tail -2
install libegl1 libgl1 libgl1-mesa-dri  # the package recommends them
inside dmoscope render /better.14 -o /better.png --size 400x300
inside test -s /better.png
install xvfb xauth
printf 'open /better.14\nsize 1280 800\nscreenshot /window.png --window\n' >"$chroot/window.dmo"
inside dmoscope script /window.dmo --headless
inside timeout 8 xvfb-run -a dmoscope /better.14 || [[ $? -eq 124 ]]  # the window stays open until it is closed
inside test -s /usr/share/bash-completion/completions/dmoscope
# shellcheck disable=SC2046
install $(deb libdmoscope0.2 python3-dmoscope)
inside python3 -c 'import dmoscope; m = dmoscope.read("/better.14"); print(m, m.statistics()["minimum"])'
install $(deb python3-dmoscope-render)
inside python3 -c 'import dmoscope; print(dmoscope.render(dmoscope.read("/better.14"), (300, 200)).shape)'
install $(deb libdmoscope-dev) g++ cmake make
cp -r "$root/examples" "$chroot/examples"
inside sh -c 'cmake -S /examples -B /built >/dev/null && cmake --build /built >/dev/null && /built/smooth_arrays'

inside apt-get purge -y -qq dmoscope libdmoscope0.2 libdmoscope-dev python3-dmoscope python3-dmoscope-render >/dev/null
left=$(inside sh -c 'find /usr /etc /var/lib -name "*dmoscope*" -not -path "/var/lib/dpkg/*" -not -path "/var/lib/apt/*"')
[[ -z $left ]] || { printf 'left behind:\n%s\n' "$left" >&2; exit 1; }
echo "installs, runs and goes again; the Debian had $(wc -w <<<"$first") packages"
