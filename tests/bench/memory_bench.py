#!/usr/bin/env python3
"""What jobs take of a worker's memory, beside what metamerd estimates and allows: memory_bench.py [BIN] [--gl]

Each scene is rendered by a daemon of its own, whose worker is looked at every 2 ms: `used` is what it has touched and
`asked` what counts against its limit (RLIMIT_DATA), at most, and beyond what it had before; both in MiB. server/service/
schedule/admission.cpp has its numbers from this table.
"""
import json, os, random, re, struct, subprocess, sys, tempfile, threading, time
from math import cos, sin
from pathlib import Path

root = Path(__file__).resolve().parents[2]
words = [word for word in sys.argv[1:] if not word.startswith('--')]
bin = Path(words[0] if words else root / 'build/release/bin')
backends = ['gl'] if '--gl' in sys.argv else ['cpu']
folder = tempfile.TemporaryDirectory()
at = Path(folder.name)

head = ('# proto-file: metamer/v1/scene.proto\n# proto-message: metamer.v1.Scene\n'
        'camera { eye { z: 4 } target {} vertical_fov: 35 }\n')
light = 'light { name: "l%d" direction { x: %g z: -1 } spectrum { standard: "D65" } luminance: 1 }\n'
material = ('material { name: "m%d" diffuse { constant: %g } specular { constant: %g } diffuseness: 0.5 specularness: 0.3 '
            'blinn_phong { shininess: 20 } }\n')
settings = 'settings { width: 320 height: 240 spp: 1 method { exact {} } }\n'


def sphere(name, of, more=''):
    x, y, z = (random.uniform(-1, 1) for _ in range(3))
    return (f'object {{ name: "s{name}" material: "m{of}" sphere {{ center {{ x: {x:.4f} y: {y:.4f} z: {z:.4f} }} '
            f'radius: 0.01 }} {more}}}\n')


def write_grid(path, side):
    with open(path, 'wb') as file:
        file.write(f'ply\nformat binary_little_endian 1.0\nelement vertex {(side + 1) ** 2}\nproperty float x\nproperty '
                   f'float y\nproperty float z\nelement face {2 * side * side}\nproperty list uchar uint vertex_indices\n'
                   'end_header\n'.encode())
        for i in range(side + 1):
            for k in range(side + 1):
                file.write(struct.pack('<fff', 2 * i / side - 1, 2 * k / side - 1,
                                       .2 * sin(9 * i / side) * cos(7 * k / side)))
        for i in range(side):
            for k in range(side):
                a = i * (side + 1) + k
                file.write(struct.pack('<BIIIBIII', 3, a, a + 1, a + side + 2, 3, a, a + side + 2, a + side + 1))


def scene(name, text):
    (at / name).write_text(text)
    return str(at / name)


def scenes():
    random.seed(1)
    one = head + light % (0, 0) + material % (0, .5, .3)
    write_grid(at / 'grid.ply', 708)
    mesh = 'object { name: "o%d" material: "m0" mesh { file: "grid.ply" } transform { translate { x: %g } } }\n'
    wide = scene('wide', head + ''.join(light % (i, i / 300) for i in range(256)) +
                 ''.join(material % (i, .1 + i / 5000, .1 + i / 6000) for i in range(4096)) +
                 ''.join(sphere(i, i) for i in range(4096)) + settings)
    gallery = str(root / 'deploy/gallery/gallery.txtpb')
    booth = str(root / 'deploy/booth/booth.txtpb')
    fine = ['--samples', '360:830:0.25']
    yield 'gallery', gallery, ['--spp', '1']
    yield 'gallery, 3840 x 2189', gallery, ['--spp', '1', '--size', '3840x2189']
    yield 'gallery, exact', gallery, ['--spp', '1', '--method', 'exact']
    yield 'gallery, ΔE00 below 0.5', gallery, ['--spp', '1', '--tolerance', '0.5']
    yield 'gallery, verify', gallery, ['--spp', '1', '--size', '400x228', '--verify']
    yield 'booth', booth, ['--spp', '1']
    yield 'a million triangles', scene('grid', one + mesh % (0, 0) + settings), []
    yield 'a million triangles, twice', scene('twice', one + mesh % (0, 0) + mesh % (1, 2) + settings), []
    yield '100,000 spheres', scene('spheres', one + ''.join(sphere(i, 0) for i in range(100000)) + settings), []
    yield '100,000 ellipsoids', scene('ellipsoids', one + ''.join(
        sphere(i, 0, 'transform { scale { x: 1 y: 2 z: 1 } } ') for i in range(100000)) + settings), []
    yield '256 lights, 4,096 materials, 1,881 wavelengths', wide, fine
    yield '256 lights, 4,096 materials, linear', wide, ['--method', 'linear']


def memory(pid):
    try:
        text = Path(f'/proc/{pid}/status').read_text()
    except OSError:
        return None
    return {key: int(re.search(rf'^{key}:\s+(\d+)', text, re.M)[1]) / 1024 for key in ('RssAnon', 'VmData')}


def measure(name, path, options, backend):
    address = f'unix:{at}/socket'
    log = open(at / 'log', 'w+')
    daemon = subprocess.Popen([bin / 'metamerd', '--listen', address, '--unconfined', '--log-level', 'debug'], stderr=log)
    while not (at / 'socket').exists():
        time.sleep(.02)
    metamer = lambda *all: subprocess.run([bin / 'metamer', *all, '--server', address, '--json'], capture_output=True, text=True)
    workers = json.loads(metamer('info').stdout)['info']['worker']
    pid = next(worker['pid'] for worker in workers if worker['backend'] == backend)
    before = memory(pid)
    peak, over = dict(before), threading.Event()

    def watch():
        while not over.wait(.002):
            now = memory(pid) or peak
            for key in peak:
                peak[key] = max(peak[key], now[key])

    watcher = threading.Thread(target=watch)
    watcher.start()
    more = ['--backend', 'gl', '--depth', '0'] if backend == 'gl' else []
    ended = metamer('render', path, '-o', str(at / 'o.exr'), *options, *more)
    over.set()
    watcher.join()
    daemon.terminate()
    daemon.wait()
    log.seek(0)
    said = re.findall(r'takes about (\d+) MiB, and may ask for (\d+) MiB', log.read())
    label = f'{name} ({backend})'
    if ended.returncode != 0 or not said:
        return print(f'{label:58} {(ended.stderr.strip() or ended.stdout.strip())[-200:]}')
    estimated, allowed = map(int, said[-1])
    used, asked = (peak[key] - before[key] for key in ('RssAnon', 'VmData'))
    print(f'{label:58} {used:6.0f} {estimated:6d} {used / estimated:6.2f}   {asked:6.0f} {allowed:6d} {asked / allowed:6.2f}',
          flush=True)


print(f'{"":58} {"used":>6} {"est.":>6} {"ratio":>6}   {"asked":>6} {"all.":>6} {"ratio":>6}')
for name, path, options in scenes():
    for backend in backends:
        if backend == 'cpu' or '--verify' not in options:
            measure(name, path, options, backend)
