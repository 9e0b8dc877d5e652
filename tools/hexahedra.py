#!/usr/bin/env python3
"""hexahedra.py DATA [--program dmoscope] [--into FOLDER]: the table of docs/hexahedra.md.

DATA: a checkout of the data of HexOpt (hovey/HexOpt), in which NAME.vtk, NAME.obj and NAMEOpt.vtk lie somewhere: the mesh, the surface that
it is to lie on, and HexOpt's result. Each mesh is smoothed by one command, and all three are judged by `dmoscope quality`."""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile
import time

HEX = ['--recipe', 'hex', '--iterations', '40']
MESHES = {'impeller': HEX, 'CAD4': [*HEX, '--max-deviation', '1e-6'],
          'mount2': ['--combine', 'mean-ratio:0.18:scaled-jacobian', '--iterations', '60', '--feature-angle', '46', '--corner-angle', '90',
                     '--max-deviation', '0.003'],
          'bunny': ['--fit', '0.05', '--combine', 'mean-ratio:0.01:scaled-jacobian', '--guard', 'off', '--iterations', '60',
                    '--feature-angle', '90', '--corner-angle', '90', '--max-deviation', '0.02']}
USUAL = ['--boundary', 'slide', '--hints', 'off']


def judge(program, mesh, surface):
    """Words on a mesh, by the program's own judgement."""
    told = json.loads(subprocess.run([program, 'quality', mesh, '--surface', surface, '--json'], check=True, capture_output=True).stdout)
    metric = {m['metric']: m for m in told['metrics']}
    scaled, ratio, distance = metric['scaled-jacobian'], metric['mean-ratio'], told['surface']['distance']
    inverted, inside = told['inverted'], told['inverted_inside_alone']
    return [f"{scaled['minimum']:.3f} / {scaled['mean']:.3f}", f"{ratio['minimum']:.4f} / {ratio['mean']:.3f}",
            'proved' if inverted == 0 else f'{inverted} inverted, {inside} of them inside alone',
            f"{distance['to']['greatest']:.1e} ({distance['to']['mean']:.1e})",
            f"{distance['back']['greatest']:.1e} ({distance['back']['mean']:.1e})"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split('\n')[0])
    parser.add_argument('data', type=pathlib.Path)
    parser.add_argument('--program', default='dmoscope')
    parser.add_argument('--into', type=pathlib.Path, help='folder for the meshes that are made')
    options = parser.parse_args()
    into = options.into or pathlib.Path(tempfile.mkdtemp())
    into.mkdir(parents=True, exist_ok=True)
    found = {path.name: path for path in sorted(options.data.rglob('*'))}
    print('| mesh | | scaled Jacobian, least / mean | mean ratio, least / mean | valid inside | greatest (mean) distance from the surface | '
          'and back | seconds |')
    print('|---|---|---|---|---|---|---|---|')
    for name, more in MESHES.items():
        if any(file not in found for file in (f'{name}.vtk', f'{name}.obj', f'{name}Opt.vtk')):
            sys.exit(f'{options.data} has no {name}.vtk, {name}.obj and {name}Opt.vtk')
        mesh, surface, result = found[f'{name}.vtk'], found[f'{name}.obj'], into / f'{name}.vtk'
        begin = time.monotonic()
        subprocess.run([options.program, 'smooth', mesh, '--surface', surface, '-o', result, *USUAL, *more], stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL)
        seconds = f'{time.monotonic() - begin:.0f}'
        for who, file, took in (('input', mesh, ''), ('HexOpt', found[f'{name}Opt.vtk'], ''), ('dmoscope', result, seconds)):
            print('|', ' | '.join([name, who, *judge(options.program, file, surface), took]), '|', flush=True)


if __name__ == '__main__':
    main()
