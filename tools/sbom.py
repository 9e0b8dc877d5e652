#!/usr/bin/env python3
"""sbom.py VERSION BINARY...: what the binaries are made of, as an SBOM (SPDX 2.3, JSON) on standard output: the Debian packages of the libraries that
they load, and of those whose code is inside (headers and static libraries), with their versions and licences."""

import datetime
import hashlib
import json
import os
import re
import subprocess
import sys

# Packages whose code becomes part of the binaries without a library to load.
INSIDE = ["libcli11-dev", "nlohmann-json3-dev", "libxsimd-dev", "libimgui-dev", "libstb-dev", "libhdf5-dev", "libaec-dev", "python3-glad"]


def say(*command):
    return subprocess.run(command, check=False, capture_output=True, text=True).stdout.strip()


def package_of(library):
    for path in (os.path.realpath(library), library, "*/" + os.path.basename(os.path.realpath(library))):
        found = say("dpkg", "-S", path)
        if found:
            return found.split(":")[0]
    return None


def licence_of(package):
    try:
        with open(f"/usr/share/doc/{package}/copyright", encoding="utf-8", errors="replace") as file:
            names = sorted(set(re.findall(r"^License: *(\S.*)$", file.read(), re.M)))
    except OSError:
        names = []
    return "; ".join(names) or "see the package's copyright file"


def entry(package, how):
    version = say("dpkg-query", "-W", "-f", "${Version}", package)
    return {"SPDXID": "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", package), "name": package, "versionInfo": version, "downloadLocation": "NOASSERTION",
            "filesAnalyzed": False, "licenseConcluded": "NOASSERTION", "licenseDeclared": "NOASSERTION", "copyrightText": "NOASSERTION",
            "licenseComments": licence_of(package), "comment": how,
            "externalRefs": [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl", "referenceLocator": f"pkg:deb/debian/{package}@{version}"}]}


def main():
    version, binaries = sys.argv[1], sys.argv[2:]
    loaded = set()
    for binary in binaries:
        for line in say("ldd", binary).splitlines():
            if match := re.search(r"=> (/\S+)", line):
                if package := package_of(match[1]):
                    loaded.add(package)
    packages = [entry(p, "loaded when it runs") for p in sorted(loaded)]
    packages += [entry(p, "its code is inside") for p in INSIDE if say("dpkg-query", "-W", "-f", "${Version}", p)]
    own = {"SPDXID": "SPDXRef-dmoscope", "name": "dmoscope", "versionInfo": version, "downloadLocation": "NOASSERTION", "filesAnalyzed": False,
           "licenseConcluded": "MIT", "licenseDeclared": "MIT", "copyrightText": "2026 the dmoscope authors"}
    made = datetime.datetime.fromtimestamp(int(os.environ.get("SOURCE_DATE_EPOCH", "0")), datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
    listed = hashlib.sha256(json.dumps(packages, sort_keys=True).encode()).hexdigest()
    json.dump({"spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": f"dmoscope-{version}",
               "documentNamespace": f"https://spdx.org/spdxdocs/dmoscope-{version}-{listed[:16]}",
               "creationInfo": {"created": made, "creators": ["Tool: dmoscope tools/sbom.py"]}, "packages": [own] + packages,
               "relationships": [{"spdxElementId": "SPDXRef-DOCUMENT", "relationshipType": "DESCRIBES", "relatedSpdxElement": "SPDXRef-dmoscope"}] +
                                [{"spdxElementId": "SPDXRef-dmoscope", "relationshipType": "DEPENDS_ON" if p["comment"].startswith("loaded") else "CONTAINS",
                                  "relatedSpdxElement": p["SPDXID"]} for p in packages]},
              sys.stdout, indent=1)
    print()


main()
