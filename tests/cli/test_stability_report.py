"""lanetrace report stability, whole: no hit is lost. test_stability_report.py LANETRACE; TAP on stdout."""
import csv
import os
import sys

from program import main, run

TABLES = ['', '-places', '-shadows', '-scenes', '-distance', '-size', '-aspect']


def stability__whole_report__nothing_lost_and_every_file(folder):
    result = run('report', 'stability', '--out', folder, '--no-pictures', '--size', '32x32', '--scene', 'builtin:rooms-804')
    assert result.returncode == 0, result.stderr
    for suffix in TABLES:
        with open(folder + '/stability' + suffix + '.csv', encoding='utf-8', newline='') as file:
            rows = list(csv.DictReader(file))
        assert rows
        for row in rows:
            assert row['lost (rays)'] == '0', (suffix, row)
    assert os.path.exists(folder + '/stability.html') and os.path.exists(folder + '/stability.json')


sys.exit(main(globals()))
