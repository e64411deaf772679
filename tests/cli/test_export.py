"""Exports of traces from outside: what other programs read, held against the statistics. test_export.py LANETRACE; TAP on stdout."""
import csv
import json
import re
import sys

from program import SMALL, fails, main, run, stats_of

MODELS = ('issue', 'core')


def trace(folder, kernel='mft-primary'):
    path = folder + '/t.ltr'
    stats_of(kernel, *SMALL, '--model', 'native', '--trace', path)
    return path


def exported(path, form, *arguments):
    out = path + '.' + form
    result = run('replay', path, '--export', form, '--out', out, *arguments)
    assert result.returncode == 0 and result.stdout == '', result.stderr
    with open(out, encoding='ascii', newline='') as file:
        return file.read()


def stats(path, *arguments):
    result = run('replay', path, '--stats', '-', *arguments)
    assert result.returncode == 0, result.stderr
    return json.loads(result.stdout)


def csv__all_tiles__every_op_and_the_cycles(folder):
    path = trace(folder)
    for model in MODELS:
        live = stats(path, '--model', model)
        rows = list(csv.DictReader(exported(path, 'csv', '--model', model).splitlines()))
        ops = [row for row in rows if row['op'] not in ('phase', 'region')]
        assert len(ops) == live['ops']['total'] and len(rows) > len(ops)
        by_op = {}
        for row in ops:
            by_op[row['mnemonic']] = by_op.get(row['mnemonic'], 0) + 1
        assert by_op == live['ops']['by_op']
        cycles = [int(row['cycle']) for row in ops]
        assert cycles == sorted(cycles) and cycles[0] == 1 and cycles[-1] == live['cycles']['total']
        assert all(int(row['ready']) >= int(row['cycle']) for row in rows)
        assert sum(row['pipe'] == 'V' for row in ops) == live['cycles']['by_stall']['issued_pair']
        assert set(row['pipe'] for row in ops) == {'U', 'V'} and {int(row['tile']) for row in rows} == set(range(9))


def csv__some_tiles__those_and_no_others(folder):
    path = trace(folder)
    whole = list(csv.DictReader(exported(path, 'csv', '--model', 'core').splitlines()))
    for tiles, first, last in (('3..5', 3, 5), ('8', 8, 8), ('0..0', 0, 0)):
        rows = list(csv.DictReader(exported(path, 'csv', '--model', 'core', '--tiles', tiles).splitlines()))
        assert rows == [row for row in whole if first <= int(row['tile']) <= last]
        alone = list(csv.DictReader(exported(path, 'csv', '--model', 'issue', '--tiles', tiles).splitlines()))
        assert len(alone) == len(rows) and {row['tile'] for row in alone} == {row['tile'] for row in rows}


def chrome__json__tiles_and_phases_add_up(folder):
    for kernel in ('mft-primary', 'packet16-primary'):
        path = trace(folder, kernel)
        live = stats(path, '--model', 'issue')
        spans = json.loads(exported(path, 'chrome', '--model', 'issue'))['traceEvents']
        tiles = [s for s in spans if s.get('cat') == 'tile']
        assert [t['args']['tile'] for t in tiles] == list(range(9)) and sum(t['args']['ops'] for t in tiles) == live['ops']['total']
        assert sum(t['dur'] for t in tiles) == live['cycles']['total']
        phases = {}
        for span in spans:
            if span.get('cat') == 'phase':
                phases[span['name']] = phases.get(span['name'], 0) + span['dur']
        assert phases == {name: cycles for name, cycles in live['cycles']['by_phase'].items() if cycles}


def chrome__core__threads_side_by_side(folder):
    path = trace(folder)
    spans = json.loads(exported(path, 'chrome', '--model', 'core'))['traceEvents']
    tiles = [s for s in spans if s.get('cat') == 'tile']
    assert {t['args']['tile'] for t in tiles} == set(range(9)) and {t['tid'] for t in tiles} == set(range(4))
    assert sum(s['name'] == 'thread_name' for s in spans) == 4
    for thread in range(4):
        own = sorted((s['ts'], s['ts'] + s['dur']) for s in tiles if s['tid'] == thread)
        assert all(a[1] <= b[0] for a, b in zip(own, own[1:]))
    assert max(t['ts'] + t['dur'] for t in tiles) == stats(path, '--model', 'core')['cycles']['total']


LINES = {
    'C': r'C\t[1-9][0-9]*',
    'I': r'I\t[0-9]+\t[0-9]+\t[0-9]+',
    'L': r'L\t[0-9]+\t[01]\t[^\t]+',
    'S': r'S\t[0-9]+\t0\t[WUVX]',
    'E': r'E\t[0-9]+\t0\t[WUVX]',
    'R': r'R\t[0-9]+\t[0-9]+\t0',
    'W': r'W\t[0-9]+\t[0-9]+\t0',
}


def read_kanata(text):
    """Check a log line by line; cycles in which each op issued, by id, and the pipe."""
    lines = text.split('\n')
    assert lines[0] == 'Kanata\t0004' and lines[1] == 'C=\t0' and lines[-1] == ''
    cycle, next_id, stage, issued = 0, 0, {}, {}
    for line in lines[2:-1]:
        word = line.split('\t')
        assert re.fullmatch(LINES[word[0]], line), line
        name, number = word[0], int(word[1])
        if name == 'C':
            cycle += number
        elif name == 'I':
            assert number == next_id
            next_id += 1
            stage[number] = None
        elif name == 'S':
            assert stage[number] is None
            stage[number] = word[3]
            if word[3] in 'UV':
                issued[number] = (cycle, word[3])
        elif name == 'E':
            assert stage[number] == word[3]
            stage[number] = None
        elif name == 'R':
            assert stage.pop(number) is None and number in issued
        elif name == 'W':
            assert number in stage and int(word[2]) in issued and int(word[2]) != number
    assert not stage
    return issued


def konata__every_line__by_its_grammar_and_as_the_csv(folder):
    path = trace(folder)
    for model in MODELS:
        for tiles in ('0..8', '4', '2..3'):
            issued = read_kanata(exported(path, 'konata', '--model', model, '--tiles', tiles))
            rows = csv.DictReader(exported(path, 'csv', '--model', model, '--tiles', tiles).splitlines())
            ops = sorted((int(row['cycle']), row['pipe']) for row in rows if row['pipe'])
            assert sorted(issued.values()) == ops


def export__wrong_words__one_line(folder):
    path = trace(folder)
    out = ['--out', folder + '/x']
    fails(['replay', path, '--export', 'vcd', *out], 'vcd')
    fails(['replay', path, '--export', 'csv'], '--out')
    fails(['replay', path, *out], '--out')
    fails(['replay', path, '--tiles', '1'], '--tiles')
    fails(['replay', path, '--export', 'csv', *out, '--stats', '-'], '--stats')
    fails(['replay', path, '--export', 'csv', *out, '--model', 'count'], 'count')
    fails(['replay', path, '--export', 'csv', *out, '--machine', 'knc', '--machine', 'larrabee'], 'one machine')
    fails(['replay', path, '--export', 'csv', *out, '--model', 'core', '--set', 'cores=2'], 'cores')
    fails(['replay', path, '--export', 'csv', '--out', folder + '/no/such'], '/no/such')
    for tiles in ('9', '0..9', '5..3', '-1', 'x', '', '1..', '..2', '1-2', '99999999999999999999'):
        fails(['replay', path, '--export', 'csv', *out, '--tiles', tiles], '--tiles')
    fails(['replay', path, '--export', 'csv', '--model', 'issue', '--out', '/dev/full'], '/dev/full', code=3)


sys.exit(main(globals()))
