#!/usr/bin/python3
"""How time and memory grow with what a scene has: growth_bench.py [--bin BIN] [--turns N] [--quick] [TABLE…]

The tables are lights, samples, wavelengths, triangles and pixels; all of them where none is named. Each figure is of a whole `metamer
render` on one thread, with a private server: CPU seconds of its worker, the least of N turns in which a table's rows take
each other's place, and what its memory had at most. `grows` is the exponent between this row and the one before: 1 is linear, 0 not at
all. --quick leaves each table's largest rows out.
"""
import argparse
import json
import os
import subprocess
import tempfile
import threading
from math import log
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
HEAD = '# proto-file: metamer/v1/scene.proto\n# proto-message: metamer.v1.Scene\n'
METHODS = {'rgb': ['--method', 'rgb'], 'linear': ['--bases', '8'], 'prefilter': ['--method', 'prefilter'],
           'exact': ['--method', 'exact']}
STANDARDS = ['D65', 'A', 'F11', 'D50', 'F2', 'F7', 'C', 'E']
TICK = os.sysconf('SC_CLK_TCK')


def lamps(count):
    angles = 2 * np.pi * np.arange(count) / count
    return ''.join(f'light {{ name: "l{i}" direction {{ x: {np.cos(a):.6f} y: -1.5 z: {np.sin(a):.6f} }} spectrum {{ standard: '
                   f'"{STANDARDS[i % len(STANDARDS)]}" }} luminance: {1 / count:.6f} }}\n' for i, a in enumerate(angles))


def paint(name, peak):
    nm = np.arange(380, 781, 10)
    values = .05 + .7 * np.exp(-((nm - peak) / 60.) ** 2)
    samples = ''.join(f'wavelength: {w} value: {v:.5f} ' for w, v in zip(nm, values))
    return (f'material {{ name: "{name}" diffuse {{ samples {{ {samples}}} }} specular {{ constant: 1 }} diffuseness: 0.8 '
            'specularness: 0.3 blinn_phong { shininess: 60 } }\n')


def balls(lights):
    """Twelve balls of twelve paints on a grey ground."""
    text = HEAD + 'camera { eye { y: 4 z: 8 } target {} vertical_fov: 42 }\n' + lamps(lights)
    text += 'material { name: "ground" diffuse { constant: 0.4 } }\n'
    text += 'object { name: "ground" material: "ground" quad { corner { x: -5 z: 5 } u { x: 10 } v { z: -10 } } }\n'
    for i in range(12):
        text += paint(f'm{i}', 400 + 28 * i)
        text += (f'object {{ name: "b{i}" material: "m{i}" sphere {{ center {{ x: {i % 4 * 2 - 3} y: 0.8 z: {i // 4 * 2 - 2} }} '
                 'radius: 0.8 } }\n')
    return text


def hills(mesh):
    """A mesh that fills the picture."""
    return (HEAD + 'camera { eye { y: 1.2 z: 1.6 } target {} vertical_fov: 50 }\n' + lamps(1) + paint('m', 550) +
            f'object {{ name: "hills" material: "m" mesh {{ file: "{mesh}" }} }}\n')


def write_hills(path, side):
    """2 × side × side triangles, as a binary PLY."""
    x, z = np.meshgrid(np.linspace(-1, 1, side + 1), np.linspace(-1, 1, side + 1))
    points = np.stack([x, .1 * np.sin(9 * x) * np.cos(7 * z), z], axis=-1).astype('<f4').reshape(-1, 3)
    corner = (np.arange(side)[:, None] * (side + 1) + np.arange(side)).ravel()
    faces = np.zeros(2 * side * side, dtype=[('n', 'u1'), ('corner', '<u4', 3)])
    faces['n'] = 3
    faces['corner'][0::2] = np.stack([corner, corner + side + 1, corner + 1], axis=-1)
    faces['corner'][1::2] = np.stack([corner + 1, corner + side + 1, corner + side + 2], axis=-1)
    with open(path, 'wb') as file:
        file.write(f'ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty float x\nproperty float y\n'
                   f'property float z\nelement face {len(faces)}\nproperty list uchar uint vertex_indices\nend_header\n'.encode())
        file.write(points.tobytes())
        file.write(faces.tobytes())


class Worker:
    """What the workers below a process have had: CPU seconds and MiB, at most, until it ends."""

    def __init__(self, parent):
        self.parent, self.cpu, self.memory, self.over = parent, {}, {}, threading.Event()
        self.thread = threading.Thread(target=self.watch)
        self.thread.start()

    def watch(self):
        while not self.over.wait(.01):
            for pid in self.below():
                try:
                    fields = Path(f'/proc/{pid}/stat').read_text().rpartition(') ')[2].split()
                    rows = Path(f'/proc/{pid}/status').read_text().splitlines()
                except OSError:
                    continue  # it has ended
                self.cpu[pid] = (int(fields[11]) + int(fields[12])) / TICK
                most = next((int(row.split()[1]) / 1024 for row in rows if row.startswith('VmHWM')), 0)  # none left: a zombie
                self.memory[pid] = max(self.memory.get(pid, 0), most)

    def below(self):
        found, look = [], [self.parent]
        while look:
            pid = look.pop()
            try:
                children = [int(word) for task in os.listdir(f'/proc/{pid}/task')
                            for word in Path(f'/proc/{pid}/task/{task}/children').read_text().split()]
                found += [child for child in children
                          if Path(f'/proc/{child}/comm').read_text().startswith('metamer-worker')]
            except OSError:
                continue
            look += children
        return found

    def end(self):
        self.over.set()
        self.thread.join()
        return sum(self.cpu.values()), max(self.memory.values(), default=0)


def render(binaries, scene, words):
    """CPU seconds and MiB of the worker, and the timing that it reports; None where the render fails, with the reason."""
    picture = Path(scene).with_suffix('.exr')
    command = [binaries / 'metamer', 'render', scene, '-o', picture, '--json', '--threads', '1', *words]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    worker = Worker(process.pid)
    out, err = process.communicate()
    cpu, memory = worker.end()
    picture.unlink(missing_ok=True)
    if process.returncode != 0:
        return None, (err or out).strip()[-200:]
    return cpu, memory, json.loads(out)['timing']


class Table:
    """Rows of (number, scene, words for each column); the columns of methods are given as ratios to the first one."""

    def __init__(self, title, unit, rows, columns):
        self.title, self.unit, self.rows, self.columns = title, unit, rows, columns

    def show(self, binaries, turns):
        least = {}
        for _ in range(turns):
            for number, scene, words in self.rows:
                for name, more in self.columns.items():
                    got = render(binaries, scene, [*words, *more])
                    if got[0] is None:
                        least[number, name] = got
                    elif (number, name) not in least or least[number, name][0] > got[0]:
                        least[number, name] = got
        print(f'\n{self.title}\n{self.unit:>12} {"MiB":>7} {"grows":>6}' +
              ''.join(f' {name + " s":>12} {"grows":>6}' if k == 0 else f' {name + " ÷":>12}' for k, name in
                      enumerate(self.columns)) + f' {"hierarchy s":>12} {"reading s":>10}')
        before = None
        for number, _, _ in self.rows:
            self.show_row(number, before, least)
            before = number

    def show_row(self, number, before, least):
        first = next(iter(self.columns))
        got = least[number, first]
        if got[0] is None:
            return print(f'{number:12,} {got[1]}')

        def grows(k):
            was = least.get((before, first))
            if before is None or was[0] is None or min(was[k], got[k]) <= 0:
                return ''
            return f'{log(got[k] / was[k]) / log(number / before):.2f}'

        line = f'{number:12,} {got[1]:7.0f} {grows(1):>6} {got[0]:12.2f} {grows(0):>6}'
        for name in list(self.columns)[1:]:
            other = least[number, name]
            line += f' {"failed" if other[0] is None else format(other[0] / got[0], ".2f"):>12}'
        timing = got[2]
        print(line + f' {timing.get("acceleration", 0):12.2f} {timing.get("compile", 0):10.2f}', flush=True)


def tables(folder, names, quick):
    def write(name, text):
        (folder / name).write_text(text)
        return folder / name

    some = lambda numbers, largest: numbers + ([] if quick else largest)
    size = ['--size', '1280x960', '--spp', '4']
    two = write('balls.txtpb', balls(2))
    if 'lights' in names:
        rows = [(n, write(f'lights{n}.txtpb', balls(n)), size) for n in some([1, 2, 4, 8, 16], [32, 64])]
        yield Table('Lights (12 paints, 1280×960, 4 samples a pixel)', 'lights', rows, METHODS)
    if 'samples' in names:
        rows = [(n, two, ['--size', '640x480', '--spp', str(n)]) for n in some([1, 2, 4, 5, 8, 12, 16], [32, 64])]
        yield Table('Samples a pixel (two lights, 12 paints, 640×480)', 'samples', rows, METHODS)
    if 'wavelengths' in names:
        steps = some([(16, 30), (46, 10), (91, 5), (451, 1)], [(901, .5), (4001, .1175)])
        rows = [(n, two, [*size, '--samples', f'360:{360 + (n - 1) * step:g}:{step:g}']) for n, step in steps]
        yield Table('Wavelengths of `point` (two lights, 12 paints, 1280×960, 4 samples a pixel)', 'wavelengths', rows, {'point': []})
    if 'triangles' in names:
        rows = []
        for side in some([71, 224, 708], [1225, 2237]):
            write_hills(folder / f'hills{side}.ply', side)
            rows.append((2 * side * side, write(f'hills{side}.txtpb', hills(f'hills{side}.ply')), size))
        yield Table('Triangles (one light, 1280×960, 4 samples a pixel; PLY without normals)', 'triangles', rows, {'exact': METHODS['exact']})
    if 'pixels' in names:
        rows = [(n * n, two, ['--size', f'{n}x{n}', '--spp', '1']) for n in some([512, 1024, 2048, 4096], [8192, 16384])]
        yield Table('Pixels (two lights, 12 paints, one sample a pixel)', 'pixels', rows, {'exact': METHODS['exact']})


def main():
    all_names = ['lights', 'samples', 'wavelengths', 'triangles', 'pixels']
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--bin', type=Path, default=ROOT / 'build/release/bin')
    parser.add_argument('--turns', type=int, default=1)
    parser.add_argument('--quick', action='store_true')
    parser.add_argument('table', nargs='*', choices=[[], *all_names], default=[], metavar='TABLE')
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        for table in tables(Path(folder), given.table or all_names, given.quick):
            table.show(given.bin, given.turns)


if __name__ == '__main__':
    main()
