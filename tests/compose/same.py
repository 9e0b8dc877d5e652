#!/usr/bin/env python3
"""same.py OLD NEW [--mixes SHARE] [--shared FOLDER] [--simd]: do two builds of the program write the same bytes? Compares exit code, standard
error and output files of:
- `smooth` for every mix of mixes.py after 2 and 20 iterations (--mixes 0.1: every tenth; --simd: by all kinds of SIMD instructions, too);
- `convert` of each mesh of FOLDER/meshes to every format, and back to VTK; five iterations of the smaller ones.
Without FOLDER (by default ../shared beside the project) only the mixes. Exits 1 where anything differs, 77 where nothing was compared."""
import argparse, concurrent.futures, os, pathlib, shutil, subprocess, sys, tempfile

import mixes

PROJECT = pathlib.Path(__file__).resolve().parents[2]
ENDINGS = ['14', '2dm', 'bdf', 'cgns', 'exo', 'inp', 'mesh', 'meshb', 'msh', 'node', 'obj', 'off', 'ply', 'pvtu', 'slf', 'stl', 'su2', 'vtk', 'vtu', 'xdmf']
SMALL = 400_000  # bytes


def outcome(program, folder, commands):
    """What commands leave one after the other: exit codes, messages, and the bytes of all files in the folder that they work in."""
    os.makedirs(folder)
    runs = [subprocess.run([program, *arguments], cwd=folder, capture_output=True, text=True, errors='replace', timeout=600) for arguments in commands]
    files = {path.relative_to(folder): path.read_bytes() for path in pathlib.Path(folder).rglob('*') if path.is_file()}
    shutil.rmtree(folder)
    return [(run.returncode, run.stderr) for run in runs], files


def mix_commands(files, share, levels):
    chosen = list(mixes.mixes())[:: max(1, round(1 / share))] if share > 0 else []
    for mix in chosen:
        for iterations in ('2', '20'):
            for level in levels:
                yield [['smooth', files[mix[0]], '-o', 'out.vtk', '--iterations', iterations, '--threads', '1', *mixes.options(mix), *level]]


def mesh_commands(folder):
    for path in sorted(p for p in folder.rglob('*') if p.is_file() and p.suffix != '.md'):
        for ending in ENDINGS:
            yield [['convert', str(path), 'out.' + ending], ['convert', 'out.' + ending, 'back.vtk']]
        if path.stat().st_size <= SMALL:
            yield [['smooth', str(path), '-o', 'out' + path.suffix, '--iterations', '5', '--threads', '1']]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('old'), parser.add_argument('new')
    parser.add_argument('--mixes', type=float, default=1.0, metavar='SHARE')
    parser.add_argument('--shared', type=pathlib.Path, default=PROJECT.parent / 'shared', metavar='FOLDER')
    parser.add_argument('--simd', action='store_true')
    given = parser.parse_args()
    old, new = os.path.abspath(given.old), os.path.abspath(given.new)
    levels = [[], *(['--simd', level] for level in ('baseline', 'avx2', 'avx512'))] if given.simd else [[]]

    with tempfile.TemporaryDirectory() as folder:
        commands = list(mix_commands(mixes.generate(old, folder), given.mixes, levels))
        if (given.shared / 'meshes').is_dir():
            commands += mesh_commands(given.shared / 'meshes')
        else:
            print(f'no meshes in {given.shared}: these are left out')

        def difference(number):
            place = os.path.join(folder, str(number))  # one for both: messages name it
            before, after = (outcome(program, place, commands[number]) for program in (old, new))
            return None if before == after else ' && '.join(' '.join(command) for command in commands[number])

        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            differing = [text for text in pool.map(difference, range(len(commands))) if text]
    for text in differing:
        print('differs:', text)
    print(f'{len(commands) - len(differing)} of {len(commands)} cases are the same')
    return 77 if not commands else 1 if differing else 0


sys.exit(main())
