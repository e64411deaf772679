"""The program lanetrace from outside: exit codes, error lines, files, statistics. test_cli.py LANETRACE; TAP on stdout."""
import json
import os
import struct
import sys

from program import SMALL, fails, gltf, main, run, stats_of, unread

HAVE_IMAGES = '--no-images' not in sys.argv[2:]
SUITES = ['mft-soft'] if '--slow-host' in sys.argv[2:] else []  # none named: all


def usage__wrong_words__one_line_and_exit_2(folder):
    fails(['frobnicate'], 'frobnicate')
    fails(['run-kernel'], 'KERNEL')
    fails(['run-kernel', 'mft-primary'], '--scene')
    fails(['run-kernel', 'mft-secondary', *SMALL], 'mft-secondary')
    fails(['run-kernel', 'mft-primary', 'packet16-primary', *SMALL], 'packet16-primary')
    fails(['run-kernel', 'mft-primary', *SMALL, '--frobnicate'], '--frobnicate')
    fails(['run-kernel', 'mft-primary', *SMALL, '--size'], '--size')
    fails(['run-kernel', 'mft-primary', '--scene', 'builtin:nowhere-1'], 'nowhere-1')
    for size in ('0x0', '0x10', '100000x100000', '16', 'axb', '10x', '-4x4', '10x10x10', ''):
        fails(['run-kernel', 'mft-primary', '--scene', 'builtin:rooms-804', '--size', size], '--size')
    for param in ('max_leaf', 'max_leaf=0', 'max_leaf=65', 'max_leaf=x', 'leaf=2', 'cull_backface=2', '=1', 'max_leaf=-1'):
        fails(['run-kernel', 'mft-primary', *SMALL, '--param', param], '--param')
    for field in ('vector_alu.latency=0', 'vector_alu.speed=1', 'nothing=1', 'issue_gap', 'issue_gap=fast'):
        fails(['run-kernel', 'mft-primary', *SMALL, '--set', field], field.split('=')[0])
    fails(['run-kernel', 'mft-primary', *SMALL, '--machine', 'pentium'], 'pentium')
    fails(['run-kernel', 'mft-primary', *SMALL, '--machine', folder + '/no.ini'], 'no.ini')
    fails(['run-kernel', 'mft-primary', *SMALL, '--model', 'guess'], 'guess')
    fails(['run-kernel', 'mft-primary', *SMALL, '--jobs', '0'], '--jobs')
    fails(['run-kernel', 'mft-primary', *SMALL, '--camera', 'nobody'], 'nobody')
    for samples in ('0', '5', '32', '8192', 'many'):
        fails(['run-kernel', 'mft-soft', *SMALL, '--samples', samples], '--samples')
    fails(['run-kernel', 'mft-primary', *SMALL, '--samples', '16'], '--samples')
    fails(['run-kernel', 'mft-primary', *SMALL, '--param', 'shrink=none'], 'shrink')
    fails(['run-kernel', 'kd16-primary', *SMALL, '--param', 'shader=phong'], "shader: no value 'phong' (there are none, simple)")
    fails(['run-kernel', 'kd16-shadow', *SMALL, '--param', 'shader=simple'], "no parameter 'shader'")
    fails(['run-kernel', 'mft-soft', *SMALL, '--param', 'shrink=all'], 'shrink')
    fails(['run-kernel', 'mft-primary', *SMALL, '--light-scale', 'nan'], '--light-scale')
    fails(['run-kernel', 'mft-primary', *SMALL, '--heatmap-of', 'aabb_tests'], '--heatmap-of')
    fails(['run-kernel', 'mft-primary', *SMALL, '--heatmap', folder + '/h.png', '--heatmap-of', 'units_packets'], 'units_packets')
    fails(['run-kernel', 'mft-primary', *SMALL, '--heatmap', folder + '/h.png', '--model', 'native'], '--heatmap')
    fails(['run-kernel', 'mft-primary', *SMALL, '--cache', folder], '--cache')
    fails(['regress', 'mft-table9'], 'mft-table9')
    fails(['kernels', 'all'], 'all')
    fails(['machines', 'pentium'], 'pentium')


def usage__error__for_the_core_model_alone(folder):
    for words in (['--model', 'issue'], ['--set', 'cores=2'], ['--trace', folder + '/t.ltr'], ['--annotate=' + folder + '/a']):
        fails(['run-kernel', 'mft-primary', *SMALL, '--error', '0.1', *words], '--error')
    fails(['run-kernel', 'mft-primary', *SMALL, '--error', '1.5'], '--error')


def scene_file__bad__one_line_names_the_file(folder):
    corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
    missing, garbage, truncated = folder + '/missing.glb', folder + '/garbage.glb', folder + '/truncated.glb'
    with open(garbage, 'wb') as file:
        file.write(b'not a glTF file at all')
    with open(truncated, 'wb') as file:
        file.write(struct.pack('<4sII', b'glTF', 2, 400) + struct.pack('<I4s', 100, b'JSON') + b'{"asset"')
    for path in (missing, garbage, truncated):
        fails(['run-kernel', 'mft-primary', '--scene', path], os.path.basename(path))
    cases = {
        'index.gltf': dict(positions=corners, indices=[0, 1, 7]),
        'nan.gltf': dict(positions=[(0, 0, 0), (1, float('nan'), 0), (0, 1, 0)]),
        'infinite.gltf': dict(positions=[(0, 0, 0), (float('inf'), 0, 0), (0, 1, 0)]),
        'empty.gltf': dict(positions=corners, nodes=[{}]),
        'accessor.gltf': dict(positions=corners, accessors=[{'bufferView': 0, 'componentType': 5126, 'count': 4000, 'type': 'VEC3'}]),
        'cycle.gltf': dict(positions=corners, nodes=[{'mesh': 0, 'children': [0]}]),
    }
    for name, case in cases.items():
        fails(['run-kernel', 'mft-primary', '--scene', gltf(folder + '/' + name, **case)], name)


def scene_file__no_camera_no_light__defaults_frame_it(folder):
    path = gltf(folder + '/plain.gltf', [(0, 0, 0), (4, 0, 0), (0, 3, 0), (4, 3, 1)], [0, 1, 2, 1, 3, 2])
    if unread(path):
        return unread(path)
    stats = stats_of('packet16-primary', '--scene', path, '--size', '64x64', '--model', 'count')
    assert stats['scene']['triangles'] == 2 and stats['counts']['isect_tests'] > 0


def output__unwritable__found_before_the_work(folder):
    for option in ('--stats', '--image', '--aov', '--heatmap', '--trace'):
        path = folder + '/no-such-folder/file' + ('.exr' if option == '--aov' else '.png')
        fails(['run-kernel', 'mft-primary', *SMALL, option, path], path)
    fails(['run-kernel', 'mft-primary', *SMALL, '--stats', folder], folder)


def output__disk_full__exit_3(folder):
    fails(['run-kernel', 'mft-primary', *SMALL, '--stats', '/dev/full'], '/dev/full', code=3)


def output__failed_run__old_file_kept_and_nothing_left(folder):
    old = folder + '/stats.json'
    with open(old, 'w', encoding='ascii') as file:
        file.write('old')
    before = sorted(os.listdir(folder))
    fails(['run-kernel', 'mft-primary', '--scene', folder + '/missing.glb', '--stats', old], 'missing.glb')
    assert open(old, encoding='ascii').read() == 'old'
    assert sorted(os.listdir(folder)) == before


def stats__schema__as_promised(folder):
    s = stats_of('mft-primary', *SMALL)
    assert s['schema'] == 'lanetrace-stats-1' and s['kernel'] == 'mft-primary' and s['model'] == 'core'
    assert s['machine']['name'] == 'larrabee' and len(s['machine']['hash']) == 16
    assert s['image'] == {'width': 48, 'height': 40} and s['scene']['triangles'] == 804
    assert s['scene']['accel']['kind'] == 'bvh' and s['scene']['accel']['nodes'] > s['scene']['accel']['leaves'] > 0
    counts = s['counts']
    assert counts['rays'] == counts['rays_primary'] == 48 * 40
    assert counts['tri_accesses'] >= counts['tri_after_culling'] and counts['isect_tests'] >= counts['tri_after_culling']
    assert counts['units']['groups'] == 9 and counts['units']['frusta'] == 120 and 'packets' not in counts['units']
    assert 'rays_shadow' not in counts and counts['aabb_tests'] == 2 * counts['traversed_inner']
    assert s['ops']['total'] == s['ops']['vector'] + s['ops']['scalar'] == sum(s['ops']['by_op'].values())
    assert 0 < s['ops']['lane_utilisation'] <= 1 and 0 < s['ops']['memory'] < s['ops']['total']
    cycles = s['cycles']
    assert sum(cycles['by_phase'].values()) == cycles['total'] == sum(cycles['by_stall'].values())
    assert abs(sum(cycles['by_basis'].values()) - 1) < 1e-5
    assert abs(cycles['per_ray'] - cycles['total'] / counts['rays']) < 1e-5
    assert set(s['host']) == {'load_s', 'build_s', 'kernel_s', 'ops_per_s', 'jobs', 'slowdown_vs_native', 'peak_rss_bytes'}
    assert set(s['build']) == {'version', 'backend', 'compiler'}


def stats__native__only_what_needs_no_accounting(folder):
    s = stats_of('packet16-primary', *SMALL, '--model', 'native')
    assert 'ops' not in s and 'cycles' not in s and s['counts']['units']['packets'] == 120


def stats__models_and_jobs__equal_counts(folder):
    for kernel in ('packet16-primary', 'mft-primary'):
        native, count, issue, core = (stats_of(kernel, *SMALL, '--model', m) for m in ('native', 'count', 'issue', 'core'))
        assert native['counts'] == count['counts'] == issue['counts'] == core['counts']
        assert count['ops'] == issue['ops'] == core['ops']
        for options in ([], ['--set', 'cores=3'], ['--model', 'issue']):
            runs = [stats_of(kernel, *SMALL, *options, '--jobs', jobs) for jobs in ('1', '2', '5')]
            assert all(run[key] == runs[0][key] for run in runs for key in ('counts', 'ops', 'cycles', 'scene', 'machine'))


def stats__core__buckets_sum_to_total(folder):
    for options in ([], ['--set', 'cores=3'], ['--machine', 'knc'], ['--set', 'threads=1']):
        cycles = stats_of('mft-primary', *SMALL, *options)['cycles']
        total, cores, threads = cycles['total'], cycles['cores'], cycles['threads']
        assert sum(cycles['by_stall'].values()) == total * cores
        assert sum(cycles['threads_by_stall'].values()) == total * cores * threads
        idle = cycles['by_stall'].get('no_work', 0)
        assert sum(cycles['by_phase'].values()) == sum(cycles['by_op'].values()) == total * cores - idle


def stats__error__an_estimate_that_says_how_good_it_is(folder):
    options = ['--scene', 'builtin:rooms-804', '--size', '384x384']
    for kernel in ('packet16-primary', 'mft-primary'):
        full = stats_of(kernel, *options)
        one, two = (stats_of(kernel, *options, '--error', '0.08', '--jobs', jobs) for jobs in '12')
        assert all(one[key] == two[key] for key in ('counts', 'ops', 'cycles'))
        assert one['counts'] == full['counts'] and one['ops'] == full['ops']
        cycles, estimate = one['cycles'], one['cycles']['estimate']
        assert 0 < estimate['rel_half_width_95'] <= 0.08 and 0 < estimate['tiles_simulated'] < estimate['tiles_total'] == 576
        assert abs(cycles['total'] / full['cycles']['total'] - 1) < 2 * estimate['rel_half_width_95']
        total = cycles['total']
        assert sum(cycles['by_stall'].values()) == sum(cycles['by_phase'].values()) == sum(cycles['by_op'].values()) == total
        assert sum(cycles['threads_by_stall'].values()) == cycles['threads'] * total
        assert 'bounds' in full['cycles'] and 'bounds' not in cycles


def stats__error__too_few_tiles_to_sample__all_of_them(folder):
    full, small = stats_of('mft-primary', *SMALL), stats_of('mft-primary', *SMALL, '--error', '0.01')
    estimate = small['cycles'].pop('estimate')
    assert estimate == {'rel_half_width_95': 0, 'tiles_simulated': 9, 'tiles_total': 9}
    assert all(small[key] == full[key] for key in ('counts', 'ops', 'cycles'))


def stats__machine_overrides__change_cycles_and_hash_only(folder):
    base, slow = stats_of('mft-primary', *SMALL), stats_of('mft-primary', *SMALL, '--set', 'issue_gap=2')
    assert slow['cycles']['total'] > base['cycles']['total'] and slow['cycles']['threads_by_stall']['gap'] > 0
    assert slow['machine']['hash'] != base['machine']['hash'] and slow['counts'] == base['counts'] and slow['ops'] == base['ops']
    knc = stats_of('mft-primary', *SMALL, '--machine', 'knc')
    assert knc['cycles']['total'] > base['cycles']['total'] and knc['machine']['name'] == 'knc'


def stats__parameters__reach_the_kernel(folder):
    deep, shallow = (stats_of('mft-primary', *SMALL, '--param', 'max_leaf=' + n) for n in ('1', '16'))
    assert deep['scene']['accel']['leaves'] > shallow['scene']['accel']['leaves'] and deep['params']['max_leaf'] == 1
    both, front = (stats_of('packet16-primary', *SMALL, '--param', 'cull_backface=' + n) for n in '01')
    assert both['counts']['tri_after_culling'] == both['counts']['tri_accesses']
    assert front['counts']['tri_after_culling'] < front['counts']['tri_accesses']


def cache__second_run__reads_what_the_first_wrote(folder):
    cache = folder + '/trees'
    words = ['run-kernel', 'kd16-primary', *SMALL, '--model', 'native', '--cache', cache, '--stats', '-']
    plain = stats_of('kd16-primary', *SMALL, '--model', 'native')
    for damage in (False, False, True, False):
        if damage:
            path = os.path.join(cache, os.listdir(cache)[0])
            with open(path, 'r+b') as file:
                file.truncate(100)
        result = run(*words)
        assert result.returncode == 0 and json.loads(result.stdout)['counts'] == plain['counts'], result.stderr
        assert ('lanetrace: note: ' in result.stderr) == damage == (cache in result.stderr), result.stderr
        assert len(os.listdir(cache)) == 1


def soft__counts_and_parameters__those_of_shadows(folder):
    packets, frusta = (stats_of(kernel, *SMALL) for kernel in ('packet16-soft', 'mft-soft'))
    primary = stats_of('packet16-primary', *SMALL)
    assert packets['params']['samples'] == 16 and packets['params']['light_scale'] == 1 and 'shrink' not in packets['params']
    assert frusta['params']['shrink'] == 'none' and frusta['params']['net'] == 'hammersley'
    assert 'samples' not in primary['params'] and 'net' not in primary['params']
    units = packets['counts']['units']['shadow_packets']
    assert 0 < units == frusta['counts']['units']['shadow_frusta'] <= 48 * 40
    for stats in (packets, frusta):
        assert stats['counts']['rays_shadow'] == 16 * units == stats['counts']['rays'] - stats['counts']['rays_primary']
        assert stats['cycles']['by_phase']['shading'] > 0
    assert 'shading' not in primary['cycles']['by_phase'] and 'rays_shadow' not in primary['counts']
    assert 'additional_tests' not in packets['counts'] and frusta['counts']['additional_tests'] == 0
    shrinking = stats_of('mft-soft', *SMALL, '--model', 'count', '--param', 'shrink=corner-rays')
    assert shrinking['counts']['additional_tests'] > 0 and shrinking['counts']['isect_tests'] < frusta['counts']['isect_tests']
    more = stats_of('mft-soft', *SMALL, '--model', 'native', '--samples', '64')
    assert more['counts']['rays_shadow'] == 64 * units and more['params']['samples'] == 64
    smaller = stats_of('mft-soft', *SMALL, '--model', 'native', '--light-scale', '0.5')
    assert smaller['params']['light_scale'] == 0.5 and smaller['counts']['isect_tests'] < frusta['counts']['isect_tests']


def pictures__all_kinds__written(folder):
    if not HAVE_IMAGES:
        return 'built without pictures'
    paths = [folder + '/' + name for name in ('a.png', 'b.exr', 'c.png', 'd.jpg', 'e.png', 'f.exr', 'g.exr', 'h.exr')]
    result = run('run-kernel', 'mft-primary', *SMALL, '--image', paths[0], '--aov', paths[1], '--heatmap', paths[2])
    assert result.returncode == 0, result.stderr
    result = run('run-kernel', 'mft-primary', *SMALL, '--heatmap', paths[3], '--heatmap-of', 'aabb_tests', '--model', 'native')
    assert result.returncode == 0, result.stderr
    result = run('run-kernel', 'mft-soft', *SMALL, '--image', paths[4], '--aov', paths[5], '--model', 'native')
    assert result.returncode == 0, result.stderr
    assert b'visibility' in open(paths[5], 'rb').read(2000) and b'visibility' not in open(paths[1], 'rb').read(2000)
    for kernel, path in (('kd16-primary', paths[6]), ('mlrta-primary', paths[7])):
        result = run('run-kernel', kernel, *SMALL, '--aov', path, '--model', 'native')
        assert result.returncode == 0, result.stderr
    assert b'complexity' in open(paths[7], 'rb').read(2000) and b'complexity' not in open(paths[6], 'rb').read(2000)
    assert all(os.path.getsize(path) > 500 for path in paths)
    fails(['run-kernel', 'mft-primary', *SMALL, '--image', folder + '/a.nothing'], 'a.nothing')
    return None


def regress__stored_baseline__equal_and_differences_named(folder):
    result = run('regress', 'mft-soft', '--baselines', folder)
    assert result.returncode == 2 and 'mft-soft.json' in result.stderr
    assert run('regress', 'mft-soft', '--baselines', folder, '--update').returncode == 0
    assert run('regress', 'mft-soft', '--baselines', folder).returncode == 0
    path = folder + '/mft-soft.json'
    baseline = json.load(open(path, encoding='utf-8'))
    baseline['runs'][0]['counts']['aabb_tests'] += 1
    json.dump(baseline, open(path, 'w', encoding='utf-8'))
    result = run('regress', 'mft-soft', '--baselines', folder)
    assert result.returncode == 1 and 'counts.aabb_tests' in result.stdout and '1 differ' in result.stdout
    with open(path, 'w', encoding='ascii') as file:
        file.write('{"runs": 3')
    fails(['regress', 'mft-soft', '--baselines', folder], 'mft-soft.json')


def regress__project_baselines__equal(folder):
    result = run('regress', *SUITES)
    assert result.returncode == 0, result.stdout + result.stderr
    if SUITES:
        print('# skipped: regress: the larger suites, in a build with sanitizers')
    assert 'mft-table1-long' not in result.stdout and 'mft-table1-long' in run('regress', '--help').stdout


def lists__text_and_json__complete(folder):
    for name, entry in (('kernels', 'mft-primary'), ('scenes', 'builtin:atrium-76k'), ('machines', 'knc'), ('ops', 'vmadd231ps')):
        text, table = run(name), run(name, '--json')
        assert text.returncode == table.returncode == 0
        assert entry in text.stdout and any(entry in row for row in json.loads(table.stdout)['rows'])
    assert 'vector_alu.latency' in run('machines', 'larrabee').stdout


def ops__machine__its_costs(folder):
    def rows(*arguments):
        table = json.loads(run('ops', '--json', *arguments).stdout)
        names = [column['name'] for column in table['columns']]
        return {row[0]: dict(zip(names, row)) for row in table['rows']}
    larrabee, knc = rows(), rows('--machine', 'knc')
    assert larrabee['load_ps']['pipes'] == 'UV' and knc['load_ps']['pipes'] == 'U'
    assert larrabee['add_ps'] == dict(larrabee['add_ps'], latency='4', throughput='1', mask='merge', rounding='nearest', chips='L K')
    assert larrabee['phase']['pipes'] == ''
    fails(['ops', '--machine', 'pentium'], 'pentium')
    fails(['ops', '--json', '--markdown'], '--markdown')
    fails(['ops', 'add_ps'], 'add_ps')


def help__every_subcommand__exit_0(folder):
    for name in ('run-kernel', 'report', 'regress', 'replay', 'sensitivity', 'kernels', 'scenes', 'machines', 'ops'):
        result = run(name, '--help')
        assert result.returncode == 0 and 'Usage: lanetrace ' + name in result.stdout, result.stdout
    assert run('--help').returncode == 0 and run().returncode == 2
    version = run('--version')
    assert version.returncode == 0 and version.stdout.startswith('lanetrace ') and version.stdout.count('\n') == 1


sys.exit(main(globals()))
