"""lanetrace report from outside: the suites, their files, bad input. test_report.py LANETRACE [--no-images]; TAP on stdout."""
import json
import os
import sys

from program import fails, gltf, main, run, unread

HAVE_IMAGES = '--no-images' not in sys.argv[2:]
SUITES = ['mft-primary', 'stability']


def own_scene(folder):
    """Four triangles in a file whose name has a blank."""
    return gltf(folder + '/own scene.gltf', [(0, 0, 0), (4, 0, 0), (0, 3, 0), (4, 3, 1)], [0, 1, 2, 1, 3, 2])


def usage__bad_words__one_line_and_nothing_written(folder):
    out = folder + '/out'
    fails(['report', 'mft-table9', '--out', out], 'mft-table9')
    fails(['report', 'mft-primary', 'mft-table9', '--out', out], 'mft-table9')
    fails(['report', '--size', '16', '--out', out], '--size')
    fails(['report', '--jobs', '0', '--out', out], '--jobs')
    fails(['report', '--machine', 'pentium', '--out', out], 'pentium')
    fails(['report', '--set', 'nothing=1', '--out', out], 'nothing')
    fails(['report', '--kernel', 'mft-primary', '--out', out], '--kernel')
    fails(['report', '--error', '0.1', '--out', out], '--error')
    assert not os.path.exists(out)
    fails(['report', '--out', folder + '/no/such', '--size', '16x16', '--no-pictures'], folder + '/no/such')
    for suite in SUITES:
        fails(['report', suite, '--scene', folder + '/missing.glb', '--size', '16x16', '--out', out], 'missing.glb')
        fails(['report', suite, '--scene', 'builtin:nowhere-1', '--size', '16x16', '--out', out], 'nowhere-1')
    assert os.listdir(out) == []


def list__every_suite__named_here_and_in_the_help(folder):
    result = run('report', '--list')
    assert result.returncode == 0 and [line.split()[0] for line in result.stdout.splitlines()] == SUITES
    text = run('report', '--help').stdout
    assert all(suite in text for suite in SUITES)


def mft_primary__own_scene__every_form(folder):
    out = folder + '/out'
    scene = own_scene(folder)
    if unread(scene):
        return unread(scene)
    pictures = [] if HAVE_IMAGES else ['--no-pictures']
    result = run('report', 'mft-primary', '--scene', scene, '--scene', scene, '--size', '40x40', '--out', out, *pictures)
    assert result.returncode == 0, result.stderr
    tables = json.load(open(out + '/mft-primary.json', encoding='utf-8'))['tables']
    assert [row[1] for row in tables[0]['rows'][:4]] == ['own scene'] * 4
    assert open(out + '/mft-primary.csv', encoding='utf-8').readline().startswith('group,scene,algorithm,rays')
    assert open(out + '/mft-primary.txt', encoding='utf-8').read() == result.stdout
    page = open(out + '/mft-primary.html', encoding='utf-8').read()
    assert page.count('<table') == 2 and (not HAVE_IMAGES or page.count('<img') == 6) and 'http' not in page.replace('http-equiv', '')
    if HAVE_IMAGES:
        assert os.path.exists(out + '/own_scene.png') and os.path.exists(out + '/own_scene-2.png')


sys.exit(main(globals()))
