#!/usr/bin/env python3
"""check_links.py FOLDER: does every link and picture of the HTML pages below FOLDER lead to a file there, and to an anchor that it has? Links to
other sites are counted and not followed."""

import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class Page(HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.links, self.anchors = [], set()
        self.feed(path.read_text(encoding="utf-8", errors="replace"))

    def handle_starttag(self, tag, attributes):
        named = dict(attributes)
        self.anchors.update(value for key, value in attributes if key == "id" or (key == "name" and tag == "a"))
        for key in ("href", "src"):
            if named.get(key):
                self.links.append(named[key])


def main():
    root = Path(sys.argv[1]).resolve()
    pages = {path: Page(path) for path in sorted(root.rglob("*.html"))}
    checked, abroad, broken = 0, 0, []
    for path, page in pages.items():
        for link in page.links:
            parts = urlsplit(link)
            if parts.scheme or link.startswith("//"):
                abroad += parts.scheme in ("http", "https")
                continue
            checked += 1
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            if not target.is_file():
                broken.append(f"{path.relative_to(root)}: {link}")
            elif parts.fragment and target in pages and unquote(parts.fragment) not in pages[target].anchors:
                broken.append(f"{path.relative_to(root)}: {link}: the page has no such anchor")
    print("\n".join(broken[:100]))
    print(f"{len(pages)} pages, {checked} links, {len(broken)} broken; {abroad} to other sites, not followed")
    sys.exit(1 if broken or not pages else 0)


main()
