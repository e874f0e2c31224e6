#!/usr/bin/env python3
"""Meshes many decks and prints one Markdown table about the results.

  study.py SCULPT [-j N] [--set 'option = value']... DECK...

Every deck runs in a folder of its own, beside links to the files of its folder. --set replaces the lines of an
option, `--set thicken_material=auto` makes the value of every such line auto. The last lines sum up.
"""
import argparse
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time


def changed(deck, settings):
    lines = deck.splitlines()
    for setting in settings:
        name, _, value = (part.strip() for part in setting.partition('='))
        if name == 'thicken_material' and value == 'auto':
            lines = [re.sub(r'^(\s*thicken_material\s*=?\s*\S+)\s+\S+', r'\1 auto', line) for line in lines]
            continue
        lines = [line for line in lines if line.split('=')[0].split()[:1] != [name]]
        begin = next(i for i, line in enumerate(lines) if line.strip().upper().startswith('BEGIN'))
        lines.insert(begin + 1, '  %s = %s' % (name, value))
    return '\n'.join(lines) + '\n'


def run(sculpt, ranks, path, settings):
    folder = tempfile.mkdtemp(prefix='study-')
    try:
        source = os.path.dirname(os.path.abspath(path))
        for name in os.listdir(source):
            if not name.endswith('.i'):
                os.symlink(os.path.join(source, name), os.path.join(folder, name))
        with open(path) as deck, open(os.path.join(folder, 'deck.i'), 'w') as out:
            out.write(changed(deck.read(), settings))
        start = time.monotonic()
        done = subprocess.run([sculpt, '-i', 'deck.i', '-j', str(ranks), '-Q', 'quality.json'], cwd=folder,
                              capture_output=True, text=True)
        seconds = time.monotonic() - start
        if done.returncode != 0:
            sys.exit('%s: %s' % (path, done.stderr.strip()[-500:]))
        with open(os.path.join(folder, 'quality.json')) as file:
            return json.load(file), seconds
    finally:
        shutil.rmtree(folder)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('sculpt')
    parser.add_argument('decks', nargs='+')
    parser.add_argument('-j', type=int, default=2)
    parser.add_argument('--set', action='append', default=[])
    arguments = parser.parse_args()
    sculpt = os.path.abspath(arguments.sculpt)
    print('| case | hexes | min SJ | mean SJ | < 0.2 | < 0.3 | invalid | kink | shortest edge | volume errors (%) | s |')
    print('|---|---|---|---|---|---|---|---|---|---|---|')
    results = []
    for path in arguments.decks:
        report, seconds = run(sculpt, arguments.j, path, arguments.set)
        s = report['summary']
        errors = [100 * (b['volume'] / b['input_volume'] - 1) for b in report['blocks'] if b.get('input_volume')]
        shown = ' '.join('%.2f' % e for e in errors) if len(errors) <= 5 else 'worst %.2f' % max(errors, key=abs)
        print('| %s | %d | %.3f | %.3f | %d | %d | %d | %.1f | %.3f | %s | %.1f |' % (
            os.path.splitext(os.path.basename(path))[0], s['hexes'], s['scaled_jacobian_min'],
            s['scaled_jacobian_mean'], s['scaled_jacobian_below_0.2'], s['scaled_jacobian_below_0.3'],
            s['jacobian_not_positive_inside'], s['interface_kink_degrees'], s['shortest_edge_cells'], shown, seconds),
            flush=True)
        results.append((s, errors, seconds))
    below = sum(1 for s, _, _ in results if s['scaled_jacobian_below_0.3'] > 0)
    invalid = sum(1 for s, _, _ in results if s['jacobian_not_positive_inside'] > 0)
    print()
    print('%d meshes: %d with hexes below 0.3, %d with invalid hexes; least min SJ %.3f; kink %.1f to %.1f degrees; '
          'shortest edge %.3f cells; largest volume error %.2f %%; %.1f s in the median, %.1f s at most, -j %d' % (
              len(results), below, invalid, min(s['scaled_jacobian_min'] for s, _, _ in results),
              min(s['interface_kink_degrees'] for s, _, _ in results),
              max(s['interface_kink_degrees'] for s, _, _ in results),
              min(s['shortest_edge_cells'] for s, _, _ in results),
              max(abs(e) for _, errors, _ in results for e in errors),
              statistics.median(t for _, _, t in results), max(t for _, _, t in results), arguments.j))


if __name__ == '__main__':
    main()
