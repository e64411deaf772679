"""A second reader of traces, written from docs/trace-format.md alone: read_trace.py LANETRACE SOURCE_ROOT; TAP on stdout.

It must find the same events as the program's own reader, which tells them as CSV.
"""
import csv
import ctypes
import ctypes.util
import os
import re
import struct
import subprocess
import sys
import tempfile

PROGRAM, ROOT = sys.argv[1], sys.argv[2]
ZSTD = ctypes.CDLL(ctypes.util.find_library('zstd') or 'libzstd.so.1')
ZSTD.ZSTD_decompress.restype = ctypes.c_size_t
ZSTD.ZSTD_decompress.argtypes = [ctypes.c_void_p, ctypes.c_size_t, ctypes.c_char_p, ctypes.c_size_t]


def rows(name, macro):
    """The rows of a .def file: lists of words up to the first string."""
    with open(os.path.join(ROOT, 'lrbni', name), encoding='utf-8') as file:
        text = re.sub(r'/\*.*?\*/', '', file.read(), flags=re.S)
    return [[w.strip(' "') for w in row.split(',')] for row in re.findall(r'(?m)^%s\((.*)\)' % macro, text)]


ACCESS = {row[0]: row[1] for row in rows('shapes.def', 'SHAPE')}
OPS = [(row[0], row[2], row[3]) for row in rows('ops.def', 'OP')]  # name, shape, class


def word(x):
    return x & 0xffffffff


def spread(x):
    return word(x * 0x9e3779b1)


def fnv(*parts):
    state = 0xcbf29ce484222325
    for part in parts:
        for byte in part:
            state = ((state ^ byte) * 0x100000001b3) & 0xffffffffffffffff
    return state


class Site:
    def __init__(self, name):
        self.op, self.next, self.name = None, 0, name % 4096 or 1
        self.clear(None, 0)

    def clear(self, op, mask):
        self.op, self.mask, self.aux, self.maker, self.offset, self.token, self.base = op, mask, 0, [0] * 4, 0, op or 0, None


class Maker:
    def __init__(self):
        self.position, self.mask, self.base = 0, 0, None


class Tile:
    def __init__(self, plain, events):
        sizes, at = struct.unpack('<6I', plain[:24]), 24
        formats, self.columns = 'BBHHHI', []
        for size, letter in zip(sizes, formats):
            self.columns.append(iter(struct.unpack('<%d%s' % (size // struct.calcsize(letter), letter), plain[at:at + size])))
            at += size
        assert at == len(plain)
        self.events = events
        self.makers = [Maker() for _ in range(8192)]
        self.outcomes, self.history, self.last = [0] * 1024, 0, [0, 0]
        self.position, self.names = 65536, {}
        self.forget()
        self.current = self.block_behind()

    def forget(self):
        self.sites, self.blocks, self.fixed = [None], {}, 0

    def new_site(self, name):
        self.sites.append(Site(name))
        return len(self.sites) - 1

    def block(self, key, name):
        key = key or 1
        if key not in self.blocks:
            if len(self.sites) == 4096 or len(self.blocks) == 512:
                self.forget()
            self.blocks[key] = self.new_site(name)
        return self.blocks[key]

    def block_behind(self):
        last, before = self.last
        return self.block(spread(last) ^ (spread(word(before + 1)) >> 5), spread(last) >> 16)

    def expected_source(self, site, i):
        distance = self.position - self.makers[site.maker[i]].position
        return distance if distance < 65536 else 0

    def known_base(self, site):
        maker = site.maker[site.base] if site.base is not None else 0
        return self.makers[maker].base if maker else None

    def expected_aux(self, site):
        base = self.known_base(site)
        return site.aux if base is None else word(base + site.offset)

    def expected_mask(self, site):
        if kind(site.op) == 'branch':
            return self.outcomes[(self.history ^ site.token) % 1024]
        return self.makers[site.maker[2]].mask if site.maker[2] else site.mask

    def read_op(self, flags):
        site = self.sites[self.current]
        if flags & 64:
            op = next(self.columns[2])
            if site.op is not None:
                self.current = self.block(word(spread(self.current * 65536 + op) + 1), site.name + 3 * op)
                site = self.sites[self.current]
            if site.op != op:
                site.clear(op, 0xffff)
                site.base = 1 if op & 0x2000 else 0 if ACCESS[OPS[op & 0xfff][1]] != 'NONE' else None
        return site

    def learn_source(self, site, i, distance):
        position = self.position - distance
        name = self.names[position] if distance else 0
        if not name or self.makers[name].position == position:
            site.maker[i] = name
            return
        if site.maker[i] < 4096:
            if self.fixed == 4096:
                return
            site.maker[i] = 4096 + self.fixed
            self.fixed += 1
        maker = self.makers[site.maker[i]]
        maker.position, maker.mask, maker.base = position, self.makers[name].mask, None

    def event(self, flags):
        site = self.read_op(flags)
        assert site.op is not None
        sources = []
        for i in range(4):
            sources.append(self.expected_source(site, i))
            if flags & 1 << i:
                sources[i] = next(self.columns[3])
                self.learn_source(site, i, sources[i])
        aux = self.expected_aux(site)
        if flags & 32:
            aux = word(aux + next(self.columns[5]))
            base = self.known_base(site)
            site.offset = site.offset if base is None else word(aux - base)
            if kind(site.op) == 'branch':
                site.token = spread(aux) // 256 ^ site.op
        mask = self.expected_mask(site)
        if flags & 16:
            mask = next(self.columns[4])
            site.mask = self.makers[site.maker[2]].mask = mask
        self.advance(site, mask, aux)
        return (site.op, mask, *sources, aux)

    def advance(self, site, mask, aux):
        site.aux = aux
        maker = site.maker[site.base] if site.base is not None else 0
        if maker and self.makers[maker].base is None:
            self.makers[maker].base = word(aux - site.offset)
        if kind(site.op) != 'marker':
            own = self.makers[site.name]
            own.position, own.base = self.position, None
            self.names[self.position] = site.name
            self.position += 1
            if kind(site.op) == 'vector_compare':
                own.mask = mask
        if kind(site.op) == 'branch':
            self.outcomes[(self.history ^ site.token) % 1024] = mask
            self.history = word(self.history * 2 + mask % 2)
            self.last = [word(site.token * 2 + mask % 2), self.last[0]]
            self.current = self.block_behind()
        elif site.next:
            self.current = site.next
        elif len(self.sites) == 4096:
            self.forget()
            self.current = self.new_site(site.name + 1)
        else:
            site.next = self.current = self.new_site(site.name + 1)

    def read(self):
        events = []
        while len(events) < self.events:
            run = next(self.columns[0])
            events += [self.event(0) for _ in range(run)]
            if run < 255 and len(events) < self.events:
                events.append(self.event(next(self.columns[1])))
        assert len(events) == self.events and all(next(column, None) is None for column in self.columns)
        return events


def kind(op):
    return OPS[op & 0xfff][2]


def read_trace(path):
    """The events of every tile."""
    with open(path, 'rb') as file:
        data = file.read()
    magic, version, text, _, tiles, _, head_hash = struct.unpack('<8sIIQIIQ', data[:40])
    assert magic == b'\x89LTR\r\n\x1a\n' and version == 1 and head_hash == fnv(data[:32], data[40:40 + text])
    index, total, tail_text, _, tail_hash, end = struct.unpack('<QQIIQ8s', data[-40:])
    assert end == b'LTR end\n' and len(data) == index + 32 * tiles + tail_text + 40 and tail_hash == fnv(data[index:-16])
    result, place = [], 40 + text
    for i in range(tiles):
        offset, size, plain_size, events, _, tile_hash = struct.unpack('<QIIIIQ', data[index + 32 * i:index + 32 * i + 32])
        packed = data[offset:offset + size]
        assert offset == place and fnv(packed) == tile_hash
        place += size
        plain = ctypes.create_string_buffer(plain_size)
        assert ZSTD.ZSTD_decompress(plain, plain_size, packed, size) == plain_size
        result.append(Tile(plain.raw, events).read())
    assert place == index and sum(map(len, result)) == total
    return result


def csv_tiles(path, tiles):
    """The same as the program tells them."""
    csv_path = path + '.csv'
    subprocess.run([PROGRAM, 'replay', path, '--model', 'issue', '--export', 'csv', '--out', csv_path], check=True)
    forms = {'': 0, 'swizzle': 1}
    for number, size in ((0, ''), (4, '4 bytes'), (5, '8 bytes'), (12, '16 bytes'), (13, '32 bytes')):
        forms.update({size: number, ('memory ' + size).strip(): number | 2})
    ids = {name: number for number, (name, _, _) in enumerate(OPS)}
    result = [[] for _ in range(tiles)]
    with open(csv_path, encoding='ascii', newline='') as file:
        for row in csv.DictReader(file):
            sources = [int(row['source%d' % i]) for i in range(4)]
            result[int(row['tile'])].append((ids[row['op']] | forms[row['form']] << 12, int(row['mask'], 16), *sources, int(row['aux'], 16)))
    return result


def main():
    kernels, failed = ('mft-primary', 'packet16-primary'), False
    print('1..%d' % len(kernels))
    for number, kernel in enumerate(kernels, 1):
        with tempfile.TemporaryDirectory() as folder:
            path = folder + '/t.ltr'
            subprocess.run([PROGRAM, 'run-kernel', kernel, '--scene', 'builtin:rooms-804', '--size', '40x24', '--model', 'native',
                            '--trace', path], check=True, stdout=subprocess.DEVNULL)
            tiles = read_trace(path)
            same = tiles == csv_tiles(path, len(tiles)) and sum(map(len, tiles)) > 10000
        failed |= not same
        print('%s %d - reader__from_the_manual_alone__same_events (%s, %d events)' % ('ok' if same else 'not ok', number, kernel, sum(map(len, tiles))))
    return failed


sys.exit(main())
