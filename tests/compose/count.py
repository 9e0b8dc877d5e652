#!/usr/bin/env python3
"""count.py PROGRAM LEAST: how many mixes of mesh, method, objective, boundary and phases `smooth` runs. Fails where fewer than LEAST do, and
prints each refusal with how many mixes it covers."""
import collections, concurrent.futures, os, sys, tempfile

import mixes


def main():
    program, least = os.path.abspath(sys.argv[1]), int(sys.argv[2])
    refusals, all_mixes = collections.Counter(), list(mixes.mixes())
    with tempfile.TemporaryDirectory() as folder:
        files = mixes.generate(program, folder)

        def refusal(number):
            mix = all_mixes[number]
            run = mixes.smooth(program, files[mix[0]], os.path.join(folder, f'{number}.vtk'), 2, mixes.options(mix))
            text = [line for line in run.stderr.split('\n') if line.strip() and '--help' not in line]
            return None if run.returncode in (0, 1) else (text or [f'exit code {run.returncode}'])[-1]

        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            refusals.update(text for text in pool.map(refusal, range(len(all_mixes))) if text)
    for text, count in refusals.most_common():
        print(f'{count:5d}  {text}')
    works = len(all_mixes) - sum(refusals.values())
    print(f'{works} of {len(all_mixes)} mixes work; at least {least} must')
    return 0 if works >= least else 1


sys.exit(main())
