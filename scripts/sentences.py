#!/usr/bin/env python3
"""Lists the sentences of pelage's documents, comments and messages, or draws a sample for readers who judge them.

A sentence of the sample is printed with its file, its line, its paragraph, the beginning of the file and its
surroundings. The beginning of a source file is its first comment, and the beginning of a document is its first
paragraph. A beginning names the subject of the file and defines symbols. The surroundings of a comment or a message are
the lines around it. The surroundings of a paragraph of a document are the headings and the lines before it. The
surroundings of a table cell are the head and the row of the table.

  scripts/sentences.py --draw 60           draws 60 sentences; the seed is the hash of HEAD
  scripts/sentences.py --list harness/mesh  lists every sentence of the files under harness/mesh
"""
import argparse
import ast
import hashlib
import io
import random
import re
import subprocess
import tokenize
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
C_LIKE = {".cpp", ".hpp", ".h", ".cl", ".clh", ".inl", ".glsl", ".vert", ".frag"}
HASH_COMMENTS = {".py", ".sh", ".toml", ".cmake", ".txt"}
FEWEST_WORDS = 4
LINES_AROUND = 4  # lines that are printed before and after a sentence's comment or paragraph


@dataclass(frozen=True)
class Paragraph:
    path: str
    line: int
    kind: str  # "document", "comment" or "message"
    text: str


def tracked(prefixes):
    names = subprocess.run(["git", "ls-files", *prefixes], cwd=ROOT, check=True, capture_output=True, text=True)
    for name in names.stdout.split("\n"):
        path = ROOT / name
        generated = name.startswith("docs/") and name.count("/") > 1
        if name and path.is_file() and not generated and not name.startswith(".ci/full-packages"):
            yield name, path


def paragraphs_of_lines(name, kind, lines):
    """Yields paragraphs. `lines` contains pairs of a line number and a text. A paragraph ends at an empty text.
    It also ends where a line number is skipped."""
    start, words, last = None, [], None
    for number, text in [*lines, (None, "")]:
        if words and (not text.strip() or (last is not None and number not in (last, last + 1))):
            yield Paragraph(name, start, kind, " ".join(words))
            words = []
        if text.strip():
            if not words:
                start = number
            words.append(text.strip())
        last = number


def markdown(name, text):
    lines, fenced = [], False
    for number, line in enumerate(text.split("\n"), 1):
        if line.lstrip().startswith("```"):
            fenced = not fenced
            line = ""
        if fenced or line.startswith(("#", "    ", "![", "<")):
            line = ""
        if line.startswith("| "):  # each cell of a table is a separate paragraph
            for cell in line.strip("|").split("|"):
                yield Paragraph(name, number, "document", cell.strip())
            line = ""
        item = re.match(r"\s*(?:[-*]|\d+\.) (.*)", line)
        if item:
            lines.append((number, ""))
            line = item.group(1)
        lines.append((number, line))
    yield from paragraphs_of_lines(name, "document", lines)


C_TOKEN = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'', re.S)


def c_like(name, text):
    """Yields the paragraphs of whole-line comments, and one paragraph per end-of-line comment. For files of harness/,
    also yields one paragraph per string literal."""
    own_lines, behind_code, messages = [], [], []
    end_of_last = -1
    for match in C_TOKEN.finditer(text):
        token, line = match.group(), text.count("\n", 0, match.start()) + 1
        before = text[text.rfind("\n", 0, match.start()) + 1:match.start()]
        if token.startswith("//"):
            (behind_code if before.strip() else own_lines).append((line, token.lstrip("/<")))
        elif token.startswith("/*"):
            own_lines += [(line + i, part.lstrip(" *")) for i, part in enumerate(token[2:-2].split("\n"))]
        elif token.startswith('"') and not before.lstrip().startswith("#"):
            body = token[1:-1].replace('\\"', '"').replace("\\n", " ")
            if messages and not text[end_of_last:match.start()].strip():  # adjacent literals form one string
                messages[-1][1] += body
            else:
                messages.append([line, body])
            end_of_last = match.end()
    yield from paragraphs_of_lines(name, "comment", own_lines)
    for line, body in behind_code:
        yield Paragraph(name, line, "comment", body.strip())
    if name.startswith("harness/"):
        for line, body in messages:
            if not re.search(r"</?[a-z]+[ >]", body):  # HTML and SVG
                yield Paragraph(name, line, "message", body.strip())


def hash_comments(name, text):
    """Yields the paragraphs of whole-line comments, and one paragraph per end-of-line comment. #SBATCH lines are
    options of Slurm, not comments."""
    own_lines = []
    for number, line in enumerate(text.split("\n"), 1):
        if re.match(r"##?SBATCH ", line):
            continue
        if own := re.match(r"\s*#(?!!)\s?(.*)", line):
            own_lines.append((number, own.group(1)))
        elif behind := re.search(r'\s#\s([^"\']*)$', line):
            yield Paragraph(name, number, "comment", behind.group(1).strip())
    yield from paragraphs_of_lines(name, "comment", own_lines)


def python(name, text):
    yield from paragraphs_of_lines(name, "comment", [
        (t.start[0], t.string.lstrip("# ")) for t in tokenize.generate_tokens(io.StringIO(text).readline)
        if t.type == tokenize.COMMENT and not t.string.startswith("#!")])
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.Module, ast.FunctionDef, ast.ClassDef)) and ast.get_docstring(node):
            for part in ast.get_docstring(node).split("\n\n"):
                if not part.startswith(" "):
                    yield Paragraph(name, getattr(node, "lineno", 1), "comment", " ".join(part.split()))


def man_page(name, text):
    lines = [(n, "" if line.startswith((".", "'")) else line.replace("\\-", "-").replace("\\f", ""))
             for n, line in enumerate(text.split("\n"), 1)]
    yield from paragraphs_of_lines(name, "document", lines)


def paragraphs(prefixes):
    for name, path in tracked(prefixes):
        suffix = path.suffix
        try:
            text = path.read_text()
        except UnicodeDecodeError:
            continue
        if suffix == ".md":
            yield from markdown(name, text)
        elif suffix in C_LIKE:
            yield from c_like(name, text)
        elif suffix == ".py":
            yield from python(name, text)
        elif suffix == ".1":
            yield from man_page(name, text)
        elif suffix in HASH_COMMENTS and not name.startswith("results/"):
            yield from hash_comments(name, text)


def sentences_of(paragraph):
    """Yields the sentences with at least FEWEST_WORDS words. This minimum excludes formulas and paths."""
    for part in re.split(r'(?<=[.?!;])["\')]*\s+(?=[A-Z`"(\[])', paragraph.text):
        part = part.strip(" ;")
        if not re.sub(r"`[^`]*`|[\s,|.;:()-]|\band\b", "", part) or part.startswith(("namespace ", "NOLINT")):
            continue  # no sentence: only names of files, code or commands, the end of a namespace, or a linter remark
        words = re.findall(r"\b[A-Za-z][a-z']+\b", part)
        if len(words) >= FEWEST_WORDS and len(set(words)) > 2:
            yield part


def beginning_of(path):
    """Returns the first comment of a source file, or the title and the first paragraph of a document."""
    lines = (ROOT / path).read_text().split("\n")
    if lines and lines[0].startswith("#!"):
        del lines[0]
    if path.endswith((".md", ".1")):
        ends = [i for i, line in enumerate(lines) if not line.strip() and i > 0 and not lines[i - 1].startswith("#")]
        return [line for line in lines[:ends[0] if ends else 1] if line.strip()]
    count = 0
    while count < len(lines) and re.match(r"//|# |#$", lines[count]):
        count += 1
    return lines[:count]


def headings_above(lines):
    """Returns the nearest heading of each level above the end of `lines`, from the outermost to the innermost."""
    headings, level = [], 7
    for line in reversed(lines):
        match = re.match(r"(#{1,6}) ", line)
        depth = len(match[1]) if match else {".SH": 1, ".SS": 2}.get(line[:3], 7)
        if depth < level:
            headings.insert(0, line)
            level = depth
    return headings


def place_of(paragraph):
    """Returns the lines that a reader sees around the paragraph. See the docstring of this file."""
    lines = (ROOT / paragraph.path).read_text().split("\n")
    at = paragraph.line - 1
    if paragraph.kind == "document":
        headings = headings_above(lines[:at])
        first = at
        while lines[first].startswith("| ") and first > 0 and lines[first - 1].startswith("| "):
            first -= 1
        if first < at:  # a table
            return [*headings, lines[first], lines[at]]
        return headings + lines[max(0, at - LINES_AROUND):at]
    end = at
    while end < len(lines) and lines[end].strip().startswith(("//", "#", "*", "/*", '"')):
        end += 1
    return lines[max(0, at - LINES_AROUND):end + LINES_AROUND]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--draw", type=int, metavar="N")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("paths", nargs="*")
    options = parser.parse_args()
    found = [(p, s) for p in paragraphs(options.paths) for s in sentences_of(p)]
    if not options.draw:
        for p, sentence in found:
            print(f"{p.path}:{p.line}: {p.kind}: {sentence}")
        return
    head = subprocess.run(["git", "rev-parse", "HEAD"], cwd=ROOT, check=True, capture_output=True, text=True).stdout.strip()
    seed = int(hashlib.sha256(head.encode()).hexdigest(), 16)
    print(f"{options.draw} of {len(found)} sentences, seed: {head}\n")
    for i, (p, sentence) in enumerate(random.Random(seed).sample(found, options.draw), 1):
        print(f"{i}. {p.path}:{p.line} ({p.kind})\n   sentence: {sentence}")
        if sentence != p.text:
            print(f"   paragraph: {p.text}")
        beginning = beginning_of(p.path)
        if p.line > len(beginning):
            print("   beginning of the file:")
            for line in beginning:
                print(f"     {line}")
        print("   place:")
        for line in place_of(p):
            print(f"     {line}")
        print()


if __name__ == "__main__":
    main()
