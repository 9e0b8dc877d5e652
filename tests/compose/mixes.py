"""Every mix of mesh, method, objective, boundary and following phase, on tiny meshes that the program generates."""
import itertools, os, subprocess

MESHES = {'triangles': ('grid', 60), 'quadrilaterals': ('quads', 60), 'mixed': ('mixed', 120), 'surface': ('can', 100), 'tetrahedra': ('tetrahedra', 60),
          'hexahedra': ('hexahedra', 60), 'solids': ('solids', 90)}
METHODS = ['dmo', 'laplace', 'smart-laplace', 'angle-based', 'dvr', 'pattern-search', 'active-set', 'joint']
OBJECTIVES = {'mean-ratio': ['--metric', 'mean-ratio'], 'scaled-jacobian': ['--metric', 'scaled-jacobian'],
              'formula': ['--metric', 'formula:det/norm^2'], 'target': ['--metric', 'mean-ratio@input'],
              'two metrics': ['--combine', 'mean-ratio:0.3:scaled-jacobian']}
BOUNDARIES = {'fixed': [], 'slide': ['--boundary', 'slide']}
PHASES = {'alone': [], 'then mean': ['--then', 'mean'], 'then joint': ['--then', 'joint'], 'then joint,mean': ['--then', 'joint,mean']}


def mixes():
    """The names of mesh, method, objective, boundary and phase of each mix that means something."""
    for mix in itertools.product(MESHES, METHODS, OBJECTIVES, BOUNDARIES, PHASES):
        _, method, objective, _, phase = mix
        without_objective = method in ('laplace', 'angle-based') and (objective != 'mean-ratio' or phase != 'alone')
        joint_twice = method == 'joint' and 'joint' in phase
        if not without_objective and not joint_twice:
            yield mix


def options(mix):
    """The options of `smooth` that a mix stands for."""
    _, method, objective, boundary, phase = mix
    return ['--method', method, *OBJECTIVES[objective], *BOUNDARIES[boundary], *PHASES[phase]]


def generate(program, folder):
    """Writes the meshes to a folder; returns the files by name."""
    files = {name: os.path.join(folder, name + '.vtk') for name in MESHES}
    for name, (kind, size) in MESHES.items():
        subprocess.run([program, 'generate', kind, '-o', files[name], '--size', str(size)], check=True, stdout=subprocess.DEVNULL)
    return files


def smooth(program, mesh, output, iterations, arguments):
    """Runs `smooth` with one thread; 0 or 1 says that it worked (1: elements are left inverted)."""
    return subprocess.run([program, 'smooth', mesh, '-o', output, '--iterations', str(iterations), '--threads', '1', *arguments],
                          capture_output=True, text=True, timeout=300)
