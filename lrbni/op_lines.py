"""Write for each op a function that tells its line first, and a macro that calls it: op_lines.py OUT.h DEPFILE ROOT COMPILER...

The ops are the functions of lrbni/ops/ that take the context, as the preprocessor sees them. The line is told in a function
so that it is told after the op's operands, which may be ops themselves, have been made.
"""
import re
import subprocess
import sys

NO_OPS = {'lrb_phase', 'lrb_region', 'lrb_line', 'lrb_far'}  # markers, which belong to no line
NO_OPS_OF = ('emit.h',)  # what ops are made of

FUNCTION = re.compile(r'always_inline\)\)\s+([\w\s*]*?)\b(lrb_\w+)\s*\(\s*lrb_ctx\s*\*\s*c\s*(?:,([^()]*))?\)\s*\{')


def ops_of(text):
    """Type, name and further parameters of each op in preprocessed text, in the order of their definition."""
    pieces = re.split(r'^# \d+ "([^"]*)".*$', text, flags=re.MULTILINE)
    bodies = {}
    for path, body in zip(pieces[1::2], pieces[2::2]):
        if '/ops/' in path and not path.endswith(NO_OPS_OF):
            bodies[path] = bodies.get(path, '') + body
    for body in bodies.values():
        for result, name, parameters in FUNCTION.findall(body):
            if name not in NO_OPS:
                yield result.strip(), name, ' '.join(parameters.split())


def write_op(file, result, name, parameters):
    names = [re.search(r'(\w+)\s*(\[\w*\])?$', parameter.strip()).group(1) for parameter in parameters.split(',') if parameter.strip()]
    declared = f', {parameters}' if names else ''
    back = '' if result == 'void' else 'return '
    file.write(f'LRB_INLINE {result} {name}_on_line(lrb_ctx *c, uint32_t on{declared})\n'
               f'{{\n    lrb_at_line(c, on);\n    {back}{name}({", ".join(["c", *names])});\n}}\n'
               f'#define {name}(c{", ..." if names else ""}) {name}_on_line(c, LRB_SITE{", __VA_ARGS__" if names else ""})\n')


def main(out, depfile, root, *compiler):
    command = [*compiler, '-E', '-D_GNU_SOURCE', '-DLRB_LEVEL=2', '-DLRB_SOURCE=0', '-I', root, '-MD', '-MF', depfile, '-MT', out,
               root + '/lrbni/lrbni.h']
    text = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout
    ops = list(ops_of(text))
    with open(out, 'w', encoding='ascii') as file:
        file.write('/* Made by lrbni/op_lines.py; included by lrbni/annotate.h, behind the ops. */\n')
        for op in ops:
            write_op(file, *op)


main(*sys.argv[1:])
