#!/usr/bin/python3
"""late_libraries.py PROGRAM SOURCE BEGINNING...: for shared libraries that PROGRAM needs and whose names begin so, writes
SOURCE, which has a stub for each function that PROGRAM takes from them. A program linked with these stubs needs none of
these libraries when it starts: the first call of a function loads its library. x86-64 alone."""
import re
import subprocess
import sys


def said_by(*words):
    return subprocess.run(words, check=True, capture_output=True, text=True, env={"LC_ALL": "C", "PATH": "/usr/bin:/bin"}).stdout


def symbols(*words):
    """Names and kinds of nm's letters."""
    for line in said_by("nm", "-D", *words).splitlines():
        *_, kind, name = line.split()
        yield name.split("@")[0], kind


TEXT = '''// Written by cmake/late_libraries.py.
#include <dlfcn.h>
#include <unistd.h>

#include <cstdio>

namespace {

struct Function {
  const char* library;
  const char* name;
};

const Function kFunctions[] = {
%(table)s};

}  // namespace

extern "C" {
extern void* swarmsmith_late_functions[];

/// Loads the library of a function. A program that cannot go on says so as the loader does at a start.
void* swarmsmith_load_late(unsigned number) {
  const Function& function = kFunctions[number];
  void* const library = dlopen(function.library, RTLD_LAZY | RTLD_GLOBAL);
  void* const found = library == nullptr ? nullptr : dlsym(library, function.name);
  if (found == nullptr) {
    std::fprintf(stderr, "%(program)s: error while loading shared libraries: %%s\\n", dlerror());
    std::fflush(nullptr);
    _exit(127);
  }
  swarmsmith_late_functions[number] = found;
  return found;
}
}

// A stub jumps to its function; before the first call, to what loads it and keeps all arguments meanwhile.
asm(R"(
  .macro late name number
  .globl \\name
  .hidden \\name
  .type \\name, @function
\\name:
  jmp *swarmsmith_late_functions+8*\\number(%%rip)
  .size \\name, .-\\name
0:
  pushq $\\number
  jmp swarmsmith_first_call
  .pushsection .data.rel.local
  .quad 0b
  .popsection
  .endm

  .data
  .section .data.rel.local, "aw"
  .balign 8
  .globl swarmsmith_late_functions
  .hidden swarmsmith_late_functions
swarmsmith_late_functions:
  .text
swarmsmith_first_call:
  push %%rdi
  push %%rsi
  push %%rdx
  push %%rcx
  push %%r8
  push %%r9
  push %%rax
  push %%r10
  sub $128, %%rsp
  movups %%xmm0, (%%rsp)
  movups %%xmm1, 16(%%rsp)
  movups %%xmm2, 32(%%rsp)
  movups %%xmm3, 48(%%rsp)
  movups %%xmm4, 64(%%rsp)
  movups %%xmm5, 80(%%rsp)
  movups %%xmm6, 96(%%rsp)
  movups %%xmm7, 112(%%rsp)
  movl 192(%%rsp), %%edi
  call swarmsmith_load_late
  mov %%rax, %%r11
  movups (%%rsp), %%xmm0
  movups 16(%%rsp), %%xmm1
  movups 32(%%rsp), %%xmm2
  movups 48(%%rsp), %%xmm3
  movups 64(%%rsp), %%xmm4
  movups 80(%%rsp), %%xmm5
  movups 96(%%rsp), %%xmm6
  movups 112(%%rsp), %%xmm7
  add $128, %%rsp
  pop %%r10
  pop %%rax
  pop %%r9
  pop %%r8
  pop %%rcx
  pop %%rdx
  pop %%rsi
  pop %%rdi
  add $8, %%rsp
  jmp *%%r11
%(stubs)s)");
'''


def main():
    program, source, *beginnings = sys.argv[1:]
    needed = re.findall(r"\(NEEDED\).*\[(.*)\]", said_by("readelf", "-dW", program))
    places = dict(re.findall(r"(\S+) => (\S+)", said_by("ldd", program)))
    late = [library for library in needed if library.startswith(tuple(beginnings))]
    wanted = {name for name, _ in symbols("--undefined-only", program)}
    copied = set(re.findall(r"_COPY.* (\S+?)(?:@\S+)? \+ 0", said_by("readelf", "-rW", program)))
    table, stubs, data = [], [], set()
    for library in late:
        for name, kind in sorted(symbols("--defined-only", places[library])):
            if name in copied or (name in wanted and kind not in "TtWwi"):
                data.add(f"{name} of {library}")
            elif name in wanted:
                wanted.remove(name)
                stubs.append(f"  late {name} {len(stubs)}\n")
                table.append(f'    {{"{library}", "{name}"}},\n')
    if data:
        sys.exit("late_libraries.py: a variable cannot come from a library that is loaded late: " + ", ".join(sorted(data)))
    text = TEXT % {"program": program.rsplit("/", 1)[-1].removesuffix("-whole"), "table": "".join(table), "stubs": "".join(stubs)}
    with open(source, "w", encoding="ascii") as file:
        file.write(text)


if __name__ == "__main__":
    main()
