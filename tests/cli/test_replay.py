"""Traces from outside: recorded, replayed, refused. test_replay.py LANETRACE MACHINES; TAP on stdout."""
import json
import re
import sys

from program import SMALL, fails, main, run, stats_of

MACHINES = sys.argv[2]


def trace__any_model_and_jobs__same_bytes(folder):
    traces = []
    for kernel in ('packet16-primary', 'mft-primary'):
        for model in ('native', 'count', 'issue', 'core'):
            for jobs in ('1', '2', '5'):
                path = folder + '/t.ltr'
                traced = stats_of(kernel, *SMALL, '--model', model, '--jobs', jobs, '--trace', path)
                plain = stats_of(kernel, *SMALL, '--model', model)
                assert numbers(traced) == numbers(plain)
                traces.append(open(path, 'rb').read())
    assert len(set(traces)) == 2 and all(trace == traces[0] for trace in traces[:12])


def numbers(stats):
    """What is equal on every host and in every run."""
    return {key: value for key, value in stats.items() if key not in ('host', 'build')}


def replayed(*arguments):
    result = run('replay', *arguments, '--stats', '-')
    assert result.returncode == 0, result.stderr
    return json.loads(result.stdout)


def replay__every_machine_and_model__as_a_live_run(folder):
    own = folder + '/own.ini'
    text = open(MACHINES + '/larrabee.ini', encoding='ascii').read()
    with open(own, 'w', encoding='ascii') as file:
        file.write(re.sub(r'(?m)^issue_gap *= *[0-9]+', 'issue_gap = 3', text))
    machines = ('larrabee', 'knc', own)
    for kernel in ('packet16-primary', 'mft-primary'):
        path = folder + '/t.ltr'
        stats_of(kernel, *SMALL, '--trace', path, '--param', 'cull_backface=1')
        for model in ('count', 'issue', 'core'):
            live = [numbers(stats_of(kernel, *SMALL, '--model', model, '--machine', m, '--param', 'cull_backface=1')) for m in machines]
            for jobs in ('1', '3'):
                alone = [numbers(replayed(path, '--model', model, '--machine', m, '--jobs', jobs)) for m in machines]
                together = replayed(path, '--model', model, '--jobs', jobs, *[w for m in machines for w in ('--machine', m)])
                assert alone == live
                assert together['schema'] == 'lanetrace-stats-list-1' and [numbers(r) for r in together['runs']] == live
        assert numbers(replayed(path, '--set', 'vector_compare.latency=6', '--set', 'issue_gap=2')) == \
            numbers(stats_of(kernel, *SMALL, '--set', 'vector_compare.latency=6', '--set', 'issue_gap=2', '--param', 'cull_backface=1'))


def replay__several_cores__as_a_live_run(folder):
    path = folder + '/t.ltr'
    for cores in ('2', '5'):
        for kernel in ('mft-primary', 'packet16-soft'):
            live = [numbers(stats_of(kernel, *SMALL, '--set', 'cores=' + cores, '--jobs', j, '--trace', path)) for j in ('1', '3')]
            assert live[0] == live[1]
            for jobs in ('1', '2', '4'):
                assert numbers(replayed(path, '--set', 'cores=' + cores, '--jobs', jobs)) == live[0]


def replay__second_pass__as_a_live_run_and_after_the_first(folder):
    path, machines = folder + '/t.ltr', ('larrabee', 'knc')
    live = [numbers(stats_of('packet16-soft', *SMALL, '--machine', m, '--jobs', '3', '--trace', path)) for m in machines]
    assert live[0]['cycles']['by_phase']['filter'] > 0
    for jobs in ('1', '3'):
        together = replayed(path, '--jobs', jobs, *[w for m in machines for w in ('--machine', m)])
        assert [numbers(r) for r in together['runs']] == live
    out = folder + '/t.csv'
    assert run('replay', path, '--model', 'core', '--export', 'csv', '--out', out).returncode == 0
    with open(out, encoding='ascii') as file:
        rows = [line.split(',') for line in file]
    at = {name: rows[0].index(name) for name in ('tile', 'cycle', 'pipe')}
    cycles = {}
    for row in rows[1:]:
        if row[at['pipe']]:  # markers have none
            cycles.setdefault(int(row[at['tile']]), []).append(int(row[at['cycle']]))
    first = len(cycles) // 2
    assert max(max(cycles[tile]) for tile in range(first)) < min(min(cycles[tile]) for tile in range(first, 2 * first))


def replay__table__that_of_run_kernel(folder):
    path = folder + '/t.ltr'
    live = run('run-kernel', 'mft-primary', *SMALL, '--trace', path).stdout.splitlines()
    again = run('replay', path, '--machine', 'larrabee').stdout.splitlines()
    assert live[:-1] == again[:-1] and live[-1].startswith('Host: ') and again[-1].startswith('Host: ')
    both = run('replay', path, '--machine', 'larrabee', '--machine', 'knc').stdout
    assert both.count('mft-primary on rooms-804') == 2 and 'machine knc' in both


def replay__bad_input__one_line(folder):
    path, damaged = folder + '/t.ltr', folder + '/damaged.ltr'
    stats_of('mft-primary', *SMALL, '--trace', path)
    fails(['replay'], 'TRACE')
    fails(['replay', path, path], path)
    fails(['replay', folder + '/missing.ltr'], 'missing.ltr')
    fails(['replay', folder], folder)
    fails(['replay', path, '--model', 'native'], '--model')
    fails(['replay', path, '--model', 'guess'], '--model')
    fails(['replay', path, '--machine', 'pentium'], 'pentium')
    fails(['replay', path, '--set', 'nothing=1'], 'nothing')
    fails(['replay', path, '--jobs', '0'], '--jobs')
    fails(['replay', path, '--stats', folder + '/no/such'], folder + '/no/such')
    data = open(path, 'rb').read()
    middle = len(data) // 2
    for text in (b'', b'nothing', data[:-1], data[:middle], data + b'x', data[:middle] + bytes([data[middle] ^ 4]) + data[middle + 1:]):
        with open(damaged, 'wb') as file:
            file.write(text)
        for jobs in ('1', '4'):
            fails(['replay', damaged, '--jobs', jobs], 'damaged.ltr')


sys.exit(main(globals()))
