#!/usr/bin/python3
"""write.py FOLDER: writes completion for each program and shell where shells look for it below a prefix such as /usr:
share/bash-completion/completions/PROGRAM, share/zsh/vendor-completions/_PROGRAM,
share/fish/vendor_completions.d/PROGRAM.fish."""
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import programs  # noqa: E402

PLACES = {"bash": "share/bash-completion/completions/{}", "zsh": "share/zsh/vendor-completions/_{}",
          "fish": "share/fish/vendor_completions.d/{}.fish"}


def write_scripts(folder):
    for shell, place in PLACES.items():
        text = (HERE / f"{shell}.in").read_text()
        for program in programs.PROGRAMS:
            path = pathlib.Path(folder) / place.format(program)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text.replace("PROGRAM", program))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    write_scripts(sys.argv[1])
