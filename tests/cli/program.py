"""What the tests of the program share: running it, its errors, scene files, cases in TAP. The program is the first argument."""
import base64
import json
import struct
import subprocess
import sys
import tempfile

PROGRAM = sys.argv[1]
SMALL = ['--scene', 'builtin:rooms-804', '--size', '48x40']


def run(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True)


def stats_of(*arguments):
    result = run('run-kernel', *arguments, '--stats', '-')
    assert result.returncode == 0, result.stderr
    return json.loads(result.stdout)


def fails(arguments, named, code=2):
    """The command fails with one line that names what is wrong, and prints nothing else."""
    result = run(*arguments)
    lines = result.stderr.splitlines()
    assert result.returncode == code, (arguments, result.returncode, result.stderr)
    assert len(lines) == 1 and lines[0].startswith('lanetrace: error: '), (arguments, result.stderr)
    assert named in lines[0], (arguments, lines[0])
    assert result.stdout == '', (arguments, result.stdout)


def gltf(path, positions, indices=None, **changes):
    """A .gltf of one mesh with its data inside."""
    data = b''.join(struct.pack('<3f', *p) for p in positions)
    attributes = {'POSITION': 0}
    primitive = {'attributes': attributes}
    views = [{'buffer': 0, 'byteLength': len(data)}]
    accessors = [{'bufferView': 0, 'componentType': 5126, 'count': len(positions), 'type': 'VEC3'}]
    if indices:
        packed = struct.pack('<%dH' % len(indices), *indices)
        primitive['indices'] = 1
        views.append({'buffer': 0, 'byteOffset': len(data), 'byteLength': len(packed)})
        accessors.append({'bufferView': 1, 'componentType': 5123, 'count': len(indices), 'type': 'SCALAR'})
        data += packed
    document = {
        'asset': {'version': '2.0'}, 'scene': 0, 'scenes': [{'nodes': [0]}], 'nodes': [{'mesh': 0}],
        'meshes': [{'primitives': [primitive]}], 'bufferViews': views, 'accessors': accessors,
        'buffers': [{'byteLength': len(data), 'uri': 'data:application/octet-stream;base64,' + base64.b64encode(data).decode()}],
    }
    document.update(changes)
    with open(path, 'w', encoding='utf-8') as file:
        json.dump(document, file)
    return path


def unread(path):
    """Why this build cannot read a good glTF file; empty if it can."""
    result = run('run-kernel', 'mft-primary', '--scene', path, '--size', '16x16', '--model', 'native')
    return 'this build reads no glTF files' if 'this build reads no glTF files' in result.stderr else ''


def main(names):
    """Run every case of a test file, each in an empty folder; the exit code. `names`: the file's globals()."""
    cases = [value for name, value in names.items() if '__' in name and callable(value) and not name.startswith('__')]
    failed = False
    print('1..%d' % len(cases))
    for number, case in enumerate(cases, 1):
        with tempfile.TemporaryDirectory() as folder:
            try:
                why = case(folder)
                print('ok %d - %s' % (number, case.__name__))
                if why:
                    print('# skipped: %s: %s' % (case.__name__, why))
            except Exception as fault:  # pylint: disable=broad-except
                failed = True
                print('not ok %d - %s' % (number, case.__name__))
                for line in repr(fault).splitlines():
                    print('# ' + line)
    return failed
