"""Where the cycles went, from outside: --annotate, --callgrind, --stat, --registers, sensitivity. test_insight.py LANETRACE; TAP."""
import json
import os
import re
import shutil
import subprocess
import sys

from program import SMALL, fails, main, run, stats_of


def texts_of(*arguments):
    result = run('run-kernel', *arguments)
    assert result.returncode == 0, result.stderr
    return result.stdout


def number(text):
    return int(text.replace(',', ''))


def annotate__source_lines__as_written_and_sum_to_the_total(folder):
    root = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..')
    for model in ('issue', 'core'):
        text = texts_of('mft-primary', *SMALL, '--model', model, '--annotate')
        stats = stats_of('mft-primary', *SMALL, '--model', model)
        assert text.startswith('mft-primary on rooms-804') and number(text.split(': ')[1].split()[0]) == stats['cycles']['total']
        sources = re.split(r'^(kernels/[\w/.]+): ([\d,]+) cycles, [\d.]+ %$', text, flags=re.MULTILINE)
        assert set(sources[1::3]) == {'kernels/slab16.h', 'kernels/traversal16.h', 'kernels/triangle16.h', 'kernels/rays16.h',
                                      'kernels/mft/corner_cull.h', 'kernels/mft/group_primary.h', 'kernels/frame16.h'}
        ops = 0
        for path, cycles, body in zip(sources[1::3], sources[2::3], sources[3::3]):
            rows = [(line[:14].strip(), line[23:37].strip(), line[70:75].strip(), line[77:]) for line in body.strip('\n').splitlines()[1:]]
            assert [int(row[2]) for row in rows] == list(range(1, len(rows) + 1)), path
            assert [row[3] for row in rows] == open(os.path.join(root, path), encoding='utf-8').read().splitlines()
            assert sum(number(row[0]) for row in rows if row[0]) == number(cycles)
            ops += sum(number(row[1]) for row in rows if row[1])
        assert sum(number(cycles) for cycles in sources[2::3]) == stats['cycles']['total'] and ops == stats['ops']['total']
    assert texts_of('mft-primary', *SMALL, '--annotate', '--jobs', '1') == texts_of('mft-primary', *SMALL, '--annotate', '--jobs', '3')
    assert texts_of('mft-primary', *SMALL, '--annotate=' + folder + '/a.txt').startswith('mft-primary on')  # the table
    assert open(folder + '/a.txt', encoding='ascii').read() == texts_of('mft-primary', *SMALL, '--annotate')


def callgrind__costs__sum_to_the_summary_and_are_accepted(folder):
    path = folder + '/callgrind.out'
    texts_of('packet16-primary', *SMALL, '--callgrind', path)
    stats = stats_of('packet16-primary', *SMALL)
    lines = open(path, encoding='ascii').read().splitlines()
    assert lines[0] == '# callgrind format' and 'positions: line' in lines
    assert 'events: Cycles Issue OperandWait MemoryWait OtherWait Ops' in lines
    costs = [[int(n) for n in line.split()[1:]] for line in lines if line[:1].isdigit()]
    totals = [sum(column) for column in zip(*costs)]
    summary = next(line for line in lines if line.startswith('summary: ')).split()[1:]
    assert totals == [int(n) for n in summary]
    assert totals[0] == stats['cycles']['total'] == sum(totals[1:5]) and totals[5] == stats['ops']['total']
    if not shutil.which('callgrind_annotate'):
        return 'there is no callgrind_annotate'
    result = subprocess.run(['callgrind_annotate', '--auto=no', path], capture_output=True, text=True)
    assert result.returncode == 0 and '%s (100.0%%)' % format(totals[0], ',') in result.stdout, result.stdout + result.stderr
    assert 'kernels/slab16.h:slab16_test' in result.stdout
    return None


def stat__listing__the_numbers_of_the_statistics(folder):
    for model in ('issue', 'core'):
        text = texts_of('mft-primary', *SMALL, '--model', model, '--stat')
        stats = stats_of('mft-primary', *SMALL, '--model', model)
        counts = {m[2].strip(): number(m[1]) for m in re.finditer(r'^ +([\d,]+)      (.{28}) # ', text, flags=re.MULTILINE)}
        assert counts['cycles'] == stats['cycles']['total'] and counts['ops'] == stats['ops']['total']
        stalls = stats['cycles']['by_stall']
        assert counts['cycles with an issue'] == stalls['issued_one'] + stalls['issued_pair']
        assert counts['cycles with two'] == stalls['issued_pair']
        parts = ('cycles with an issue', 'operand waits', 'memory waits', 'branch waits', 'other waits')
        assert sum(counts[part] for part in parts) == counts['cycles']
        assert ('branch-misses' in counts) == (model == 'core')


def registers__statistics__pressure_and_no_spills(folder):
    for model in ('issue', 'core'):
        registers = stats_of('packet16-primary', *SMALL, '--model', model, '--registers')['registers']
        assert registers['spill_cycles'] == 0 and set(registers) == {'vector', 'mask', 'general', 'spill_cycles'}
        for file, limit in (('vector', 32), ('mask', 8), ('general', 16)):
            for phase in registers[file].values():
                assert 0 < phase['mean'] <= phase['max'] <= limit and phase['stores'] == phase['reloads'] == 0
    assert 'registers' not in stats_of('packet16-primary', *SMALL)
    assert 'Registers: values that are live at once' in texts_of('packet16-primary', *SMALL, '--registers')


def analyses__what_cannot_be__said_so(folder):
    for option in ('--annotate', '--stat', '--registers', '--callgrind=' + folder + '/c.out'):
        fails(['run-kernel', 'mft-primary', *SMALL, option, '--model', 'count'], option.split('=')[0])
    fails(['run-kernel', 'mft-primary', *SMALL, '--annotate', '--trace', folder + '/t.ltr'], '--annotate')
    fails(['run-kernel', 'mft-primary', *SMALL, '--annotate', '--stats', '-'], '--annotate')
    fails(['run-kernel', 'mft-primary', *SMALL, '--callgrind', folder + '/no/c.out'], folder + '/no/c.out')
    assert os.listdir(folder) == []


def stats__by_op_and_lanes__sum_to_the_total(folder):
    for model in ('issue', 'core'):
        cycles = stats_of('mft-primary', *SMALL, '--model', model)['cycles']
        assert sum(cycles['by_op'].values()) == cycles['total']
        assert set(cycles['lane_utilisation']) == set(cycles['by_phase'])
        assert all(0 < share <= 1 for share in cycles['lane_utilisation'].values())


def sensitivity__rows__as_runs_with_the_number_changed(folder):
    trace = folder + '/t.ltr'
    texts_of('mft-primary', *SMALL, '--trace', trace, '--model', 'native')
    for model in ('issue', 'core'):
        arguments = ['--model', model, '--json']
        result = run('sensitivity', 'mft-primary', *SMALL, *arguments)
        assert result.returncode == 0, result.stderr
        again = run('sensitivity', trace, *arguments, '--jobs', '1')
        assert again.returncode == 0 and again.stdout == result.stdout
        table = json.loads(result.stdout)
        base = stats_of('mft-primary', *SMALL, '--model', model)['cycles']['total']
        names = [column['name'] for column in table['columns']]
        rows = [dict(zip(names, row)) for row in table['rows']]
        assert names[:5] == ['field', 'value', 'changed to', 'cycles', 'change'] and len(rows) > 50
        assert all(row['cycles'] - row['change'] == base for row in rows)
        changes = [abs(row['change']) for row in rows]
        assert changes == sorted(changes, reverse=True) and changes[0] > 0
        wanted = {'vector_alu.latency', 'machine.issue_gap'} | ({'memory.latency', 'machine.threads'} if model == 'core' else set())
        assert wanted <= {row['field'] for row in rows}
        for row in [row for row in rows if row['field'] in wanted]:
            assignment = row['field'] + '=' + row['changed to']
            assert stats_of('mft-primary', *SMALL, '--model', model, '--set', assignment)['cycles']['total'] == row['cycles']
    assert 'vector_alu.latency' in run('sensitivity', trace).stdout


def sensitivity__wrong_words__one_line(folder):
    fails(['sensitivity'], 'KERNEL')
    fails(['sensitivity', 'mft-primary'], '--scene')
    fails(['sensitivity', 'mft-secondary', *SMALL], 'mft-secondary')
    fails(['sensitivity', 'mft-primary', *SMALL, '--model', 'count'], '--model')
    fails(['sensitivity', folder + '/none.ltr'], 'none.ltr')
    fails(['sensitivity', folder + '/none.ltr', '--size', '16x16'], 'none.ltr')
    fails(['sensitivity', 'mft-primary', '--scene', 'builtin:nowhere-1'], 'nowhere-1')


sys.exit(main(globals()))
