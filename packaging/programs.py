"""What the programs declare of themselves: `PROGRAM --declared` prints it. Man pages, completion and the manual are made
of nothing else, so that they cannot differ from the programs."""
import json
import pathlib
import subprocess

#: All programs with options of their own; a new one is a name here.
PROGRAMS = ("swarmsmith", "swarmsmith-worker", "swarmsmith-track", "swarmsmith-robot")


def declared(bin_folder, program):
    """Program, purpose, begin, commands: name, summary, details, options: names, value, help, choices, ..."""
    path = pathlib.Path(bin_folder) / program
    done = subprocess.run([path, "--declared"], capture_output=True, text=True, timeout=60, check=True)
    return json.loads(done.stdout)


def built(bin_folder):
    """The programs that are there: a build may leave out tracking."""
    return [program for program in PROGRAMS if (pathlib.Path(bin_folder) / program).exists()]


def version(bin_folder):
    done = subprocess.run([pathlib.Path(bin_folder) / "swarmsmith", "version", "--json"], capture_output=True, text=True,
                          timeout=60, check=True)
    return json.loads(done.stdout)["version"]


def page_name(program, command=""):
    """"swarmsmith-track-calibrate-camera": the man page of a program or of one of its commands."""
    return "-".join([*program.split(), *command.split()])


def options_of(command):
    return [option for option in command["options"] if not option["word"]]


def words_of(command):
    return [option for option in command["options"] if option["word"]]


def synopsis(program, command):
    """["swarmsmith figure", "[OPTIONS]", "[KIND]", "[STORE]"]; options that must be there are spelled out."""
    parts = [f"{program} {command['name']}".strip()]
    for option in options_of(command):
        if option["required"]:
            parts.append(f"{option['names'][-1]} {option['value']}")
    parts.append("[OPTIONS]")
    for word in words_of(command):
        name = word["names"][0] + ("..." if word["repeats"] else "")
        parts.append(name if word["required"] else f"[{name}]")
    return parts


def examples_of(details):
    """The text of a command before its examples, the examples' lines, and the text after them."""
    lines = details.strip("\n").split("\n")
    start = next((i for i, line in enumerate(lines) if line in ("Example:", "Examples:")), None)
    if start is None:
        return details.strip("\n"), [], ""
    end = start + 1
    while end < len(lines) and (lines[end].startswith("  ")):
        end += 1
    return "\n".join(lines[:start]).strip("\n"), [line[2:] for line in lines[start + 1:end]], "\n".join(lines[end:]).strip("\n")


def paragraphs(text):
    """Blocks between empty lines: ("text", line) for what is to be filled, ("lines", lines) for what is aligned."""
    for block in text.split("\n\n"):
        lines = block.strip("\n").split("\n")
        if not block.strip():
            continue
        if any(line.startswith(" ") for line in lines):
            yield "lines", lines
        else:
            yield "text", " ".join(lines)
