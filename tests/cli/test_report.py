"""lanetrace report from outside: the suites, their files, bad input. test_report.py LANETRACE [--no-images]; TAP on stdout."""
import json
import os
import shutil
import subprocess
import sys

from program import PROGRAM, fails, gltf, main, run, stats_of, unread

HAVE_GNUPLOT = shutil.which('gnuplot') is not None
HAVE_IMAGES = '--no-images' not in sys.argv[2:]
SUITES = ['mft-primary', 'models', 'mft-table1', 'mft-table2', 'mft-light-size', 'mft-packet256', 'mft-quality', 'mft-msaa', 'mft-prediction', 'stability',
          'mlrta-table1', 'mlrta-table2', 'mlrta-table3', 'mlrta-tiles', 'mlrta-culling', 'mlrta-params', 'mlrta-adaptive']


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


def tables_of(out, suite):
    """The tables by title, each a list of rows by column."""
    tables = json.load(open('%s/%s.json' % (out, suite), encoding='utf-8'))['tables']
    return {t['title']: [dict(zip([c['name'] for c in t['columns']], row)) for row in t['rows']] for t in tables}


def report(folder, suite, *arguments):
    """Run a suite; its tables. Text on stdout and in the file are the same, and every table is in the page and has its CSV file."""
    out = folder + '/out'
    result = run('report', suite, '--out', out, *arguments)
    assert result.returncode == 0, result.stderr
    assert open('%s/%s.txt' % (out, suite), encoding='utf-8').read() == result.stdout
    tables = tables_of(out, suite)
    assert open('%s/%s.html' % (out, suite), encoding='utf-8').read().count('<table') == len(tables)
    assert sum(name.startswith(suite) and name.endswith('.csv') for name in os.listdir(out)) == len(tables)
    return tables


def models__own_scene__cycles_of_every_model_as_run_alone(folder):
    scene = ['--scene', own_scene(folder), '--size', '64x48']
    if unread(scene[1]):
        return unread(scene[1])
    rows = report(folder, 'models', *scene, '--kernel', 'mft-primary')['Models: host time, and error of the cycles']
    by_model = {row['model']: row for row in rows}
    assert len(rows) == len(by_model) == 10 and {row['kernel'] for row in rows} == {'mft-primary'}
    for name, options in {'count': ['--model', 'count'], 'issue': ['--model', 'issue'], 'core': [], 'core, without threads': ['--set', 'threads=1'],
                          'core, without caches': ['--set', 'l2.latency=3', '--set', 'memory.latency=3', '--set', 'l2.cycles_per_line=0',
                                                   '--set', 'memory.cycles_per_line=0', '--set', 'memory.chip_bytes_per_cycle=0'],
                          'core, without mispredictions': ['--set', 'branch.mispredict_penalty=0', '--set', 'branch.btb_miss_penalty=0']}.items():
        assert by_model[name]['cycles'] == stats_of('mft-primary', *scene, *options)['cycles']['total'], name
        assert abs(by_model[name]['error'] - 100 * (by_model[name]['cycles'] / by_model['core']['cycles'] - 1)) < 0.006
    assert by_model['native']['cycles'] is None and by_model['native']['x native'] == 1
    assert all(row['host time'] > 0 for row in rows) and by_model['core, without threads']['changed'] == 'machine.threads=1'
    return None


def models__builtin_scene__cycles_do_not_depend_on_jobs(folder):
    arguments = ['--scene', 'builtin:rooms-804', '--size', '32x32', '--no-pictures', '--set', 'l1.latency=4', '--kernel', 'packet16-primary']
    one, two = (report(folder + '/' + jobs, 'models', *arguments, '--jobs', jobs) for jobs in '12' if not os.mkdir(folder + '/' + jobs))
    title = 'Models: host time, and error of the cycles'
    assert [(r['kernel'], r['model'], r['cycles']) for r in one[title]] == [(r['kernel'], r['model'], r['cycles']) for r in two[title]]
    assert any('memory.latency=4' in r['changed'] for r in one[title])
    assert not any(name.endswith('.png') for name in os.listdir(folder + '/1/out'))
    fails(['report', 'models', '--kernel', 'mft-primry', '--out', folder + '/no'], 'mft-primry')
    fails(['report', 'models', '--set', 'cores=2', '--out', folder + '/no'], 'cores')


def without_filter(stats):
    return stats['cycles']['total'] - stats['cycles']['by_phase'].get('filter', 0)


TABLE1 = 'MFT Table 1: measured, and published by Benthin and Wald 2009'


def mft_table1__builtin_scenes__as_run_alone_and_published_beside(folder):
    pictures = [] if HAVE_IMAGES else ['--no-pictures']
    tables = report(folder, 'mft-table1', '--scene', 'builtin:hall-60k', '--scene', 'builtin:rooms-804', '--size', '32x24', *pictures)
    rows = tables[TABLE1]
    published = [row for row in rows if row['basis'] == 'published']
    assert len(published) == 16 and len({(row['scene'], row['algorithm']) for row in published}) == 16
    phases = {(r['scene'], r['algorithm']): r for r in tables['Cycles by phase']}
    for kernel, algorithm in (('packet16-primary', 'P-Packet'), ('mft-primary', 'P-Frusta'), ('mft-soft', 'S-Frusta')):
        stats = stats_of(kernel, '--scene', 'builtin:rooms-804', '--size', '32x24', '--param', 'cull_backface=1')
        row = next(r for r in rows if r['scene'] == 'rooms-804' and r['algorithm'] == algorithm)
        assert row['cycles'] == without_filter(stats) and row['AABB tests'] == stats['counts']['aabb_tests']
        assert all((phases[('rooms-804', algorithm)][name] or 0) == stats['cycles']['by_phase'].get(phase, 0) for name, phase in (
            ('set-up', 'setup'), ('traversal', 'traversal'), ('culling', 'culling'), ('shading', 'shading'), ('filter', 'filter')))
    assert phases[('rooms-804', 'S-Frusta')]['filter'] > 0
    at = next(i for i, r in enumerate(rows) if r['scene'] == 'hall-60k' and r['algorithm'] == 'P-Frusta')
    assert rows[at + 1]['scene'] == 'Call of Juarez Saloon (60K tri)' and rows[at + 1]['cycles'] == 31500000
    doubtful = next(r for r in published if r['scene'].startswith('Fern') and r['algorithm'] == 'S-Packet')
    assert doubtful['doubtful readings'] == 'uncertain: after culling, cycles'
    reductions = tables['Reductions: packets / frusta']
    ours = next(r for r in reductions if r['scene'] == 'hall-60k' and r['rays'] == 'primary rays')
    packet, frusta = (next(r for r in rows if r['scene'] == 'hall-60k' and r['algorithm'] == a) for a in ('P-Packet', 'P-Frusta'))
    assert abs(ours['cycles'] - packet['cycles'] / frusta['cycles']) < 0.006
    assert 'P-Frusta has' in tables['Where reductions differ'][0]['in words']
    if HAVE_IMAGES:
        assert os.path.exists(folder + '/out/hall-60k-mft-primary-core-cycles.png')


def mft_table1__own_scene__sampled(folder):
    scene = own_scene(folder)
    if unread(scene):
        return unread(scene)
    tables = report(folder, 'mft-table1', '--scene', scene, '--size', '48x48', '--error', '0.1', '--no-pictures')
    assert {row['filter'] for row in tables['Cycles by phase']} == {None}
    assert [r['basis'] for r in tables[TABLE1]] == ['measured'] * (4 if 'mft-soft' in run('kernels').stdout else 2) + ['published'] * 16 and tables['Where reductions differ'] == []
    fails(['report', 'mft-table1', '--error', '1.5', '--out', folder + '/no'], '--error')
    fails(['report', 'mft-table1', '--error', 'x', '--out', folder + '/no'], '--error')
    return None


def files_of(out):
    return {name: open(out + '/' + name, 'rb').read() for name in sorted(os.listdir(out))}


def runs_side_by_side__any_jobs__same_bytes(folder):
    pictures = [] if HAVE_IMAGES else ['--no-pictures']
    scenes = ['--scene', 'builtin:rooms-804', '--scene', 'builtin:hall-60k', *pictures]
    for suite, *words in (('mft-table1', '--size', '32x24'), ('mft-table1', '--size', '96x96', '--error', '0.2'), ('mft-msaa', '--size', '24x16')):
        outs = ['%s/%s-%d-%s' % (folder, suite, len(words), jobs) for jobs in '13']
        results = [run('report', suite, *scenes, *words, '--jobs', out[-1], '--out', out) for out in outs]
        assert all(result.returncode == 0 for result in results), results[0].stderr + results[1].stderr
        assert results[0].stdout == results[1].stdout and files_of(outs[0]) == files_of(outs[1]), suite


def runs_side_by_side__one_fails__one_line_and_no_files(folder):
    out = folder + '/out'
    for jobs in '13':
        words = ['report', 'mft-table1', '--scene', 'builtin:rooms-804', '--size', '16x16', '--jobs', jobs, '--out', out]
        fails([*words, '--error', '0.1', '--set', 'cores=2'], 'cores')
        fails([*words, '--scene', folder + '/missing.glb'], 'missing.glb')
        assert os.listdir(out) == []


TABLE2 = 'MFT Table 2: shadow rays only, measured, and published by Benthin and Wald 2009'


def mft_table2__builtin_scene__frame_less_its_primary_rays(folder):
    scene = ['--scene', 'builtin:rooms-804', '--size', '32x24']
    tables = report(folder, 'mft-table2', *scene)
    rows, changes = ({row['variant']: row for row in tables[title] if row['basis'] == 'measured'} for title in (TABLE2, 'Changes against no shrinking'))
    primary = stats_of('mft-primary', *scene, '--param', 'cull_backface=1')
    for variant, shrink in {'No Shrink': 'none', 'CR': 'corner-rays', 'FS': 'frusta', 'Ray-AABB': 'ray-aabb'}.items():
        stats = stats_of('mft-soft', *scene, '--param', 'cull_backface=1', '--param', 'shrink=' + shrink)
        row = rows[variant]
        for name, counter in {'triangle accesses': 'tri_accesses', 'after culling': 'tri_after_culling', 'AABB tests': 'aabb_tests',
                              'intersection tests': 'isect_tests'}.items():
            assert row[name] == stats['counts'][counter] - primary['counts'][counter] >= 0, (variant, name)
        assert row['cycles'] == without_filter(stats) - primary['cycles']['total'] > 0
        assert row['cycles of the frame'] == without_filter(stats) and row['additional tests'] == stats['counts']['additional_tests']
    assert abs(changes['CR']['intersection tests'] - 100 * (rows['CR']['intersection tests'] / rows['No Shrink']['intersection tests'] - 1)) < 0.06
    published = [row for row in tables[TABLE2] if row['basis'] == 'published']
    assert [row['variant'] for row in published if row['doubtful readings']] == ['CR'] and published[0]['AABB tests'] == 1459000
    assert tables['Where changes differ'] == []


def mft_table2__own_scene__sampled(folder):
    scene = own_scene(folder)
    if unread(scene):
        return unread(scene)
    rows = report(folder, 'mft-table2', '--scene', scene, '--size', '48x48', '--error', '0.1', '--no-pictures')[TABLE2]
    assert [row['basis'] for row in rows] == ['measured'] * 4 + ['published'] * 4
    assert rows[0]['scene'] == 'own scene' and rows[4]['group'] == 'published, not measured here'
    return None


def mft_light_size__own_scene__as_run_alone(folder):
    scene = ['--scene', own_scene(folder), '--size', '32x32']
    if unread(scene[1]):
        return unread(scene[1])
    tables = report(folder, 'mft-light-size', *scene)
    runs = {(row['light scale'], row['algorithm']): row for row in tables['Soft shadows by the size of the light']}
    assert len(runs) == 10
    for scale in (0.125, 2):
        for kernel, algorithm in (('packet16-soft', 'S-Packet'), ('mft-soft', 'S-Frusta')):
            stats = stats_of(kernel, *scene, '--param', 'cull_backface=1', '--light-scale', str(scale))
            row = runs[(scale, algorithm)]
            assert row['cycles'] == without_filter(stats) and row['AABB tests'] == stats['counts']['aabb_tests']
            assert row['shadow rays'] == stats['counts']['rays_shadow']
    ratios = tables['Packets / frusta by the size of the light']
    assert [row['light scale'] for row in ratios] == [0.125, 0.25, 0.5, 1, 2] + [None] * 4
    assert all(abs(row['cycles'] - runs[(row['light scale'], 'S-Packet')]['cycles'] / runs[(row['light scale'], 'S-Frusta')]['cycles']) < 0.006
               for row in ratios[:5])
    return None


def mft_packet256__own_scene__as_run_alone(folder):
    scene = ['--scene', own_scene(folder), '--size', '32x32']
    if unread(scene[1]):
        return unread(scene[1])
    tables = report(folder, 'mft-packet256', *scene)
    runs = {row['algorithm']: row for row in tables['Packets of 16 rays, packets of 256, frusta']}
    assert len(runs) == 6
    for kernel, algorithm in (('packet256-primary', 'P-Packet, 256 rays'), ('packet256-soft', 'S-Packet, 256 rays'), ('mft-soft', 'S-Frusta')):
        stats = stats_of(kernel, *scene, '--param', 'cull_backface=1')
        row, counts = runs[algorithm], stats['counts']
        assert row['cycles'] == without_filter(stats) and row['AABB tests'] == counts['aabb_tests']
        assert row['boxes'] == counts.get('aabb_group_tests', counts['aabb_tests'])
    ratios = tables['Packets of 256 rays, measured and as the paper has them']
    assert [row['rays'] for row in ratios] == ['primary', 'primary and shadow', None]
    assert ratios[0]['speed against frusta'] == '%.0f%%' % (100 * runs['P-Frusta']['cycles'] / runs['P-Packet, 256 rays']['cycles'])
    assert ratios[2]['boxes against frusta'] == '3% to 4% fewer' and ratios[2]['speed against frusta'] == 'at most 50%'
    return None


def mft_quality__builtin_scene__errors_fall_with_samples(folder):
    scene = ['--scene', 'builtin:rooms-804', '--size', '24x24']
    pictures = [] if HAVE_IMAGES else ['--no-pictures']
    tables = report(folder, 'mft-quality', *scene, *pictures)
    ways = {(row['samples'], row['interleaved'], row['filter']): row for row in tables['Soft shadows: cycles, and error of the visibility']}
    assert len(ways) == 14
    for interleaved, number in (('no', 0), ('yes', 1)):
        stats = stats_of('mft-soft', *scene, '--samples', '4', '--param', 'cull_backface=1', '--param', 'interleaved=%d' % number)
        assert ways[(4, interleaved, 'yes')]['cycles'] == stats['cycles']['total']
        assert ways[(4, interleaved, 'no')]['cycles'] == without_filter(stats) < stats['cycles']['total']
        errors = [ways[(samples, interleaved, 'no')]['inside penumbrae, RMSE'] for samples in (4, 16, 64)] + [ways[(256, 'no', 'no')]['inside penumbrae, RMSE']]
        assert errors == sorted(errors, reverse=True) and errors[0] > 4 * errors[3] > 0, errors
    assert all(row['inside penumbrae, RMSE'] <= row['inside penumbrae, worst'] <= 1 for row in ways.values())
    figure = tables['Figure 5: 16 samples against 256']
    assert [row['picture'] for row in figure[::4]] == ['24x24', '48x48', '96x96'] and all(row['shadow rays'] == 6.25 for row in figure)
    assert figure[3]['inside penumbrae, RMSE'] > figure[11]['inside penumbrae, RMSE'] > 0
    if HAVE_IMAGES:
        assert all(os.path.exists(folder + '/out/rooms-804-' + rest) for rest in ('256-samples.png', '16-interleaved-filtered.png'))


def mft_msaa__builtin_scene__as_run_alone(folder):
    pictures = [] if HAVE_IMAGES else ['--no-pictures']
    scene = ['--scene', 'builtin:rooms-804', '--size', '40x30']
    tables = report(folder, 'mft-msaa', *scene, *pictures)
    marked, published = tables['Adaptive anti-aliasing: marked pixels']
    cycles, = tables['Adaptive anti-aliasing: cycles']
    none, adaptive, full = tables['Adaptive anti-aliasing: error of the picture']
    alone = stats_of('mft-msaa', *scene, '--param', 'cull_backface=1')
    only = stats_of('mft-msaa', *scene, '--param', 'cull_backface=1', '--param', 'retrace=0')
    blocks = stats_of('mft-msaa', *scene, '--param', 'cull_backface=1', '--param', 'marking=block', '--model', 'native')
    primary = stats_of('mft-primary', *scene, '--param', 'cull_backface=1')
    large = stats_of('mft-primary', '--scene', 'builtin:rooms-804', '--size', '160x120', '--param', 'cull_backface=1')
    counts = alone['counts']
    assert abs(marked['marked'] - 100 * counts['pixels_marked'] / 1200) < 0.006 and marked['edge pixels missed'] == 0 and marked['recall'] == 100
    assert abs(marked['marked by blocks'] - 100 * blocks['counts']['pixels_marked'] / 1200) < 0.006
    assert marked['silhouettes'] == counts['silhouettes'] and marked['edge tests'] == counts['edge_tests'] and 50 < marked['precision'] <= 100
    assert published['marked'] == 11.5 and published['recall'] is None
    assert counts['rays'] == 1200 + counts['rays_msaa'] and counts['rays_msaa'] == 16 * counts['pixels_marked']
    total = {name: stats['cycles']['total'] for name, stats in
             {'primary': primary, 'only': only, 'alone': alone, 'large': large}.items()}
    for column, value in {'primary rays': total['primary'], 'marking': total['only'] - total['primary'], 'samples': total['alone'] - total['only'],
                          'adaptive': total['alone'], '16 rays a pixel': total['large']}.items():
        assert abs(cycles[column] - value / 1e6) < 0.00051, column
    assert only['cycles']['by_phase']['silhouettes'] > 0 and 'silhouettes' not in primary['cycles']['by_phase']
    assert [row['rays per pixel'] for row in (none, full)] == [1, 16] and none['RMSE'] > adaptive['RMSE'] >= full['RMSE'] > 0
    fails(['report', 'mft-msaa', '--size', '4096x16', '--out', folder + '/no'], '--size')
    if HAVE_IMAGES:
        assert all(os.path.exists(folder + '/out/rooms-804' + rest) for rest in ('-1-ray.png', '-adaptive.png', '-16-rays.png', '-marked.png'))


def mft_msaa__own_scene__every_form(folder):
    scene = own_scene(folder)
    if unread(scene):
        return unread(scene)
    tables = report(folder, 'mft-msaa', '--scene', scene, '--size', '32x24', '--no-pictures')
    assert [row['scene'] for row in tables['Adaptive anti-aliasing: cycles']] == ['own scene']
    assert tables['Adaptive anti-aliasing: marked pixels'][0]['edge pixels missed'] == 0
    return None


def mft_quality__own_scene__every_form(folder):
    scene = own_scene(folder)
    if unread(scene):
        return unread(scene)
    tables = report(folder, 'mft-quality', '--scene', scene, '--size', '16x16', '--no-pictures')
    assert {row['scene'] for rows in tables.values() for row in rows} == {'own scene'}
    return None


PUBLISHED = {'T-Rex (69K tri)': (58e3, 173e3, 125e3, 19.5e6), 'Call of Juarez Saloon (60K tri)': (388e3, 204e3, 150e3, 31.5e6)}


def mft_prediction__two_scenes__costs_times_published_counts(folder):
    scenes, small = ['rooms-804', 'hall-60k'], ['--size', '16x16']
    arguments = [word for scene in scenes for word in ('--scene', 'builtin:' + scene)] + small
    tables = report(folder, 'mft-prediction', *arguments)
    stats = [stats_of('mft-primary', '--scene', 'builtin:' + scene, *small, '--param', 'cull_backface=1', '--set', 'threads=1') for scene in scenes]
    cost = {phase: sum(s['cycles']['by_phase'][phase] for s in stats) / sum(events(s['counts']) for s in stats) for phase, events in {
        'setup': lambda n: 16 * 16, 'traversal': lambda n: n['aabb_tests'], 'culling': lambda n: n['tri_accesses'],
        'intersection': lambda n: n['isect_tests']}.items()}
    rows = {(r['group'], r['scene'], r['algorithm']): r for r in tables['Predicted and published cycles']}
    for scene, (boxes, triangles, tests, cycles) in PUBLISHED.items():
        row = rows[('1 thread; a test is a pair', scene, 'P-Frusta')]
        predicted = 1024 * 1024 * cost['setup'] + 2 * boxes * cost['traversal'] + triangles * cost['culling'] + tests * cost['intersection']
        assert row['published'] == cycles and abs(row['predicted'] / predicted - 1) < 1e-6
        assert abs(row['error'] - 100 * (predicted / cycles - 1)) < 0.06
        assert abs(row['AABB tests'] - 100 * 2 * boxes * cost['traversal'] / predicted) < 0.06
    costs = {(r['machine'], r['algorithm'], r['event']): r for r in tables['What events cost']}
    assert abs(costs[('1 thread', 'P-Frusta', 'triangle access')]['cycles'] - cost['culling']) < 0.006
    assert all(r['least scene'] <= r['cycles'] <= r['dearest scene'] for r in costs.values())
    summary = tables["Predicted cycles of the paper's own counts: errors by reading"]
    best = min(summary, key=lambda r: r['all, median'])
    far = {(r['scene'], r['algorithm']): r for r in tables['Rows that are far off']}
    name = best['machine'] + ('; a test is a pair' if 'pair' in best['an AABB test is'] else '; a test is a box')
    assert set(far) == {key[1:] for key, r in rows.items() if key[0] == name and abs(r['error']) > 30}
    assert len(summary) == 8 and len(rows) == 8 * len({(scene, algorithm) for _, scene, algorithm in rows})
    mine = sorted(abs(r['error']) for key, r in rows.items() if key[0] == '1 thread; a test is a pair')
    line = next(r for r in summary if r['machine'] == '1 thread' and r['an AABB test is'] == 'a pair of boxes')
    assert abs(line['all, worst'] - mine[-1]) < 0.11 and abs(line['all, median'] - (mine[len(mine) // 2 - 1] + mine[len(mine) // 2]) / 2) < 0.11
    fails(['report', 'mft-prediction', '--set', 'cores=2', '--out', folder + '/no'], 'cores')


def mft_prediction__own_scene__all_forms(folder):
    scene = own_scene(folder)
    if unread(scene):
        return unread(scene)
    tables = report(folder, 'mft-prediction', '--scene', scene, '--size', '16x16', '--no-pictures', '--machine', 'knc', '--set', 'threads=2')
    assert {r['machine'] for r in tables['What events cost']} == {'2 threads', '1 thread', '2 threads, no cache misses', '1 thread, no cache misses'}
    return None


ROOMS = ['--scene', 'builtin:rooms-804', '--size', '128x96']
BY_READING = {('traversed cells', 'inner nodes'): lambda n: n['traversed_inner'], ('traversed cells', 'inner nodes and leaves'): lambda n: n['traversed_cells'],
              ('intersections', 'tests that give a nearer hit'): lambda n: n['isect_hits'], ('intersections', 'tests'): lambda n: n['isect_tests'],
              ('intersections', 'tests without a mailbox'): lambda n: n['isect_tests'] + n['mailbox_hits']}


def counts_of(kernel, *arguments):
    return stats_of(kernel, '--model', 'native', *arguments)['counts']


def mlrta_tables_2_and_3__builtin_scene__counts_a_packet_as_run_alone_and_published_beside(folder):
    for number, rays, of_paper in (('2', 'primary', (13.00, 3.98)), ('3', 'shadow', (24.83, 10.07))):
        tables = report(folder, 'mlrta-table' + number, *ROOMS)
        rows = next(rows for title, rows in tables.items() if title.startswith('MLRTA Table ' + number))
        by_reading = {(r['count'], r['reading']): r for r in rows if r['scene'] == 'rooms-804'}
        counts = {column: counts_of('%s-%s' % (kernel, rays), *ROOMS) for column, kernel in (('no MLRT', 'kd16'), ('MLRT', 'mlrta'))}
        for reading, total in BY_READING.items():
            for column, n in counts.items():
                assert abs(by_reading[reading][column] - total(n) / (32 * 24)) < 0.00501, (number, reading, column)
            assert abs(by_reading[reading]['reduction'] - total(counts['no MLRT']) / total(counts['MLRT'])) < 0.00501
        searches = by_reading[('cells, EP only', 'inner nodes and leaves')]
        assert searches['no MLRT'] is None and abs(searches['MLRT'] - counts['MLRT']['ep_cells'] / (32 * 24)) < 0.00501
        assert searches['MLRT, published'] == (0.51 if number == '2' else None)
        cells = by_reading[('traversed cells', 'inner nodes')]
        assert (cells['no MLRT, published'], cells['MLRT, published']) == of_paper
        assert {r['scene'] for r in rows if r['reading'] == 'published, not measured here'} == {
            'Conference (274K tri)', 'Soda Hall (2195K tri)', 'Asian Dragon (7M tri)'}
        assert [r['packets of the picture'] for r in tables['Packets, tiles and searches']] == [32 * 24] * 2


def mlrta_table3__builtin_scene__tests_by_what_searches_found_add_up(folder):
    rows = report(folder, 'mlrta-table3', *ROOMS)['Tests of shadow rays, by what the search of their tile has found']
    primary, root = counts_of('kd16-primary', *ROOMS), counts_of('kd16-shadow', *ROOMS)
    entry = [counts_of('mlrta-' + rays, *ROOMS, '--param', 'its=16') for rays in ('primary', 'shadow')]
    assert sum(r['packets'] for r in rows) == root['units']['hard_packets']
    for counter, name in (('isect_tests', 'tests'), ('traversed_cells', 'cells')):
        for column, expected in (('no MLRT', root[counter] - primary[counter]), ('MLRT', entry[1][counter] - entry[0][counter])):
            total = sum(r['%s, %s' % (name, column)] * r['packets'] for r in rows if r['packets'])
            assert abs(total - expected) <= 0.0051 * root['units']['hard_packets'], (name, column)
    by_found = {r['found']: r for r in rows}
    assert by_found['no bounds: packets start at the root']['tests, change'] in (0, None)
    assert by_found['nothing in the way']['tests, MLRT'] in (0, None)


def cache__suite_twice__same_tables_one_tree(folder):
    cache = folder + '/trees'
    tables = [report(folder, 'mlrta-table2', *ROOMS, *words) for words in ([], ['--cache', cache], ['--cache', cache])]
    assert tables[0] == tables[1] == tables[2] and len(os.listdir(cache)) == 1


def mlrta_table1__builtin_scene__frames_of_the_core_models_cycles(folder):
    small = ['--scene', 'builtin:rooms-804', '--size', '32x24']
    tables = report(folder, 'mlrta-table1', *small)
    rows = {r['system']: r for r in next(iter(tables.values())) if r['scene'] in ('rooms-804', 'Erw6 (804 tri)')}
    for kernel in ('kd16-primary', 'mlrta-primary', 'packet16-primary', 'mft-primary'):
        cycles = stats_of(kernel, *small)['cycles']['total']
        rays = 32 * 24 * 1e9 / cycles
        assert abs(rows[kernel]['null shader, rays'] - rays / 1e6) < 0.0501 and abs(rows[kernel]['null shader'] - rays / 1024 ** 2) < 0.00501
        shaded = stats_of(kernel, *small, '--param', 'shader=simple')['cycles']
        assert abs(rows[kernel]['simple shader'] - 32 * 24 * 1e9 / shaded['total'] / 1024 ** 2) < 0.00501
        assert shaded['by_phase']['shading'] > 0 and 'shading' not in stats_of(kernel, *small)['cycles']['by_phase']
    assert rows['MLRTA 2.4 GHz P4 1 thread']['null shader'] == 70.2 and rows['MLRTA 2.4 GHz P4 1 thread']['simple shader'] == 37.8
    fails(['report', 'mlrta-table1', '--set', 'cores=2', '--out', folder + '/no'], 'cores')


def mlrta_tiles__two_scenes__drawn_as_the_kernel_counts(folder):
    for scene in ('rooms-804', 'hall-60k'):
        where = ['--scene', 'builtin:' + scene, '--size', '300x200']
        rows = report(folder, 'mlrta-tiles', *where, *([] if HAVE_IMAGES else ['--no-pictures']))['Tiles by size']
        by_size = {r['tiles']: r for r in rows}
        drawn, counted = by_size.pop('all, as drawn'), by_size.pop('all, as the kernel counted')
        n = stats_of('mlrta-primary', *where, '--model', 'native')['counts']['units']
        assert (counted['searched'], counted['divergent']) == (n['tiles'], n['divergent_tiles'])
        assert (drawn['searched'], drawn['divergent']) == (n['tiles'], n['divergent_tiles']), scene
        assert by_size['128x128']['searched'] + by_size['128x128']['divergent'] == 6 and '32x32' in by_size
        assert sum(r['divergent'] for r in by_size.values()) > 0
        assert os.path.exists('%s/out/%s-mlrta-tiles.png' % (folder, scene)) == HAVE_IMAGES


def mlrta_culling__builtin_scene__only_corner_rays_lose_hits(folder):
    rows = report(folder, 'mlrta-culling', *ROOMS, *([] if HAVE_IMAGES else ['--no-pictures']))['Ways to cull in entry-point searches']
    assert len(rows) == 6 and all(r['hits'] > 0 for r in rows)
    assert all(r['lost hits'] == 0 for r in rows if r['culling'] != 'corner rays')
    assert max(r['lost hits'] for r in rows if r['culling'] == 'corner rays') > 0
    inverse, direct = rows[:2]
    for row, culling in ((inverse, 'inverse'), (direct, 'direct')):
        n = counts_of('mlrta-primary', *ROOMS, '--param', 'culling=' + culling)
        assert row['culling'] == culling and abs(row['EP steps'] - n['ep_cells'] / (32 * 24)) < 0.000501
    assert inverse['EP steps, against inverse'] == 0
    assert os.path.exists(folder + '/out/rooms-804-mlrta-corner-rays-lost.png') == HAVE_IMAGES


def mlrta_params__builtin_scene__each_setting_as_run_alone(folder):
    tables = report(folder, 'mlrta-params', *ROOMS)
    rows = tables['Parameters of multi-level ray tracing and of its tree']
    means = {r['setting']: r for r in tables['What settings change against the defaults, means over the scenes']} # of one scene
    by_setting = {r['setting']: r for r in rows}
    assert os.path.exists(folder + '/out/mlrta-params-splitting.png') == HAVE_GNUPLOT
    defaults = by_setting['defaults']
    assert len(by_setting) == len(rows) > 20
    for setting in ('sf=4 mts=8', 'covered_planes=0', 'mailbox=0'):
        words = [word for assignment in setting.split() for word in ('--param', assignment)]
        n = counts_of('mlrta-primary', *ROOMS, *words)
        cycles = stats_of('mlrta-primary', *ROOMS, '--model', 'issue', *words)['cycles']['total']
        assert abs(by_setting[setting]['cycles, MLRT'] - cycles / 1e6) < 0.0501, setting
        assert abs(by_setting[setting]['cells, MLRT'] - n['traversed_cells'] / (32 * 24)) < 0.00501, setting
        assert abs(means[setting]['cycles, MLRT'] - by_setting[setting]['MLRT, cycles against defaults']) < 0.01, setting
        assert abs(by_setting[setting]['tests, MLRT'] - n['isect_tests'] / (32 * 24)) < 0.00501, setting
    n = counts_of('kd16-primary', *ROOMS, '--param', 'covered_planes=0')
    assert abs(by_setting['covered_planes=0']['cells, no MLRT'] - n['traversed_cells'] / (32 * 24)) < 0.00501
    assert by_setting['sf=4 mts=8']['cells, no MLRT'] == defaults['cells, no MLRT'] and defaults['MLRT, against defaults'] == 0


def mlrta_adaptive__builtin_scene__costs_of_runs_alone_and_no_more_rays_than_even(folder):
    where = ['--scene', 'builtin:rooms-804', '--size', '96x64']
    rows = report(folder, 'mlrta-adaptive', *where, *([] if HAVE_IMAGES else ['--no-pictures']))[
        'Samples by complexity against even samples, at equal error of the picture']
    for samples, size, its in (('1', '96x64', '16'), ('4', '192x128', '32')):
        even, root, steps, error = [row for row in rows if row['as good as'] == samples]
        alone = stats_of('mlrta-primary', '--scene', 'builtin:rooms-804', '--size', size, '--model', 'issue', '--param', 'its=' + its,
                         *(['--param', 'sf=4', '--param', 'mts=8'] if samples == '1' else []))
        assert even['rays'] == float(samples) and even['samples given'] == 'evenly'
        assert abs(even['cycles'] - alone['cycles']['total'] / (96 * 64)) < 0.06
        assert all(row['RMSE'] <= even['RMSE'] for row in (root, steps, error))
        assert error['rays'] < even['rays'] and steps['rays'] <= even['rays'] and root['by chance'] > root['RMSE']
    for name in ('rooms-804-mlrta-adaptive', 'rooms-804-mlrta-complexity', 'rooms-804-mlrta-samples'):
        assert os.path.exists('%s/out/%s.png' % (folder, name)) == HAVE_IMAGES
    fails(['report', 'mlrta-adaptive', '--size', '33x32', '--out', folder + '/no'], '33x32')
    fails(['report', 'mlrta-adaptive', '--size', '4096x32', '--out', folder + '/no'], '2048')


def mlrta_suites__own_scene__all_forms(folder):
    scene = own_scene(folder)
    if unread(scene):
        return unread(scene)
    for suite in SUITES:
        if suite.startswith('mlrta'):
            tables = report(folder, suite, '--scene', scene, '--size', '40x20', '--no-pictures')
            assert any(row['scene'] == 'own scene' for row in next(iter(tables.values()))), suite
    return None


def plot__no_gnuplot__tables_written_and_a_line(folder):
    out = folder + '/out'
    words = [PROGRAM, 'report', 'models', '--scene', 'builtin:rooms-804', '--size', '16x16', '--kernel', 'mft-primary', '--out', out]
    result = subprocess.run(words, capture_output=True, text=True, env={'PATH': folder})
    assert result.returncode == 0 and result.stderr.count('\n') == 1 and 'gnuplot' in result.stderr, result.stderr
    assert 'there was no gnuplot' in open(out + '/models.html', encoding='utf-8').read() and os.path.exists(out + '/models.csv')
    assert not os.path.exists(out + '/models-speed-error.png')


sys.exit(main(globals()))
