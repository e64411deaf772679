"""What the tests of the program share: running it, its errors, cases in TAP. The program is the first argument."""
import json
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
