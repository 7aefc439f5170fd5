"""Checks comments, docstrings, strings and pages for the private words of Testing/words.txt.

Run: python3 check_words.py FILE...     (.h, .cxx, .py, .md, .xml; Testing/lint gives all)

Skips code, text in backquotes, strings of fewer than 12 characters and fields of f-strings. Also
checks the first word of each C++ comment and docstring. Prints
`file:line: "word": write "field's word"`; exits with 1 if a word is found.
"""

import ast
import io
import re
import sys
import tokenize
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

SHORTEST = 12
HEAD = re.compile(r"\s*(?:@brief\s+)?(What|Whether|Of|Which|As|That|The same|Those|Such|So|How)\b")
CXX = re.compile(
    r"""/\*(?P<block>.*?)\*/|//(?P<line>[^\n]*)|R"(?P<mark>\w*)\((?P<raw>.*?)\)(?P=mark)"
    |(?P<string>"(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*)|(?<!\w)'(?:[^'\\\n]|\\.)+'""",
    re.DOTALL | re.VERBOSE,
)
CODE = {
    ".md": r"(?ms)^ *```.*?^ *```|\]\([^()\s]+\)",
    ".xml": r"</?[\w:]+|[\w:]+=(\"[^\"]{0,11}\")?",
}


class Prose(NamedTuple):
    line: int
    text: str
    has_head: bool = False  # its first word is checked


def read_words(path: Path) -> list[tuple[re.Pattern[str], str]]:
    """Patterns of private words, and the field's words; a space matches a line break too."""
    lines = path.read_text(encoding="utf-8").splitlines()
    pairs = [line.rsplit(" -> ", 1) for line in lines if line and not line.startswith("#")]
    return [(re.compile(old.strip().replace(" ", r"\s+"), re.I), new) for old, new in pairs]


def blank(pattern: str, text: str) -> str:
    """Replaces the matches of a pattern, except their line breaks."""
    return re.sub(pattern, lambda match: "\0" + "\n" * match[0].count("\n"), text)


def join_strings(source: str) -> str:
    """Adjacent string literals as one text, with the line breaks between them."""
    joined = re.sub(r"""(["'])(\s*)[bfr]*\1""", r"\2", source[1:-1])
    return re.sub(r"\\[nrt\"']", "  ", joined)


def join_lines(comments: list[tuple[int, bool, str]], has_head: bool) -> Iterator[Prose]:
    """Joins comments on consecutive lines; a comment after code begins a new text."""
    first, lines = 0, list[str]()
    for number, is_alone, text in comments:
        if lines and not (is_alone and number == first + len(lines)):
            yield Prose(first, "\n".join(lines), has_head)
            lines = []
        first = first if lines else number
        lines.append(text)
    if lines:
        yield Prose(first, "\n".join(lines), has_head)


def read_cxx(text: str) -> Iterator[Prose]:
    lines = []
    for match in CXX.finditer(text):
        number = text.count("\n", 0, match.start()) + 1
        if match["block"]:
            yield Prose(number, re.sub(r"(?m)^[ \t]*\*+<?", "", match["block"]), True)
        elif match["line"]:
            is_alone = not text[: match.start()].rpartition("\n")[2].strip()
            lines.append((number, is_alone, match["line"].lstrip("/!<")))
        elif len(match["raw"] or match["string"] or "") >= SHORTEST:
            yield Prose(number, match["raw"] or join_strings(match["string"]))
    yield from join_lines(lines, True)


def read_python(text: str) -> Iterator[Prose]:
    comments = []
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT:
            is_alone = not token.line[: token.start[1]].strip()
            comments.append((token.start[0], is_alone, token.string[1:]))
    yield from join_lines(comments, False)
    tree, source = ast.parse(text), text.encode().splitlines(keepends=True)
    docstrings = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
    for node in ast.walk(tree):
        if isinstance(node, ast.JoinedStr | ast.Constant):
            lines = source[node.lineno - 1 : node.end_lineno]
            lines[-1] = lines[-1][: node.end_col_offset]
            literal = b"".join(lines)[node.col_offset :].decode()
            if id(node) in docstrings:
                yield Prose(node.lineno, literal.lstrip("rR").strip('"'), True)
            elif len(literal) >= SHORTEST + 2:
                yield Prose(node.lineno, blank(r"\{[^{}]*\}", join_strings(literal)))


def read(text: str, suffix: str) -> Iterator[Prose]:
    if suffix in CODE:
        return iter([Prose(1, blank(CODE[suffix], text))])
    return read_python(text) if suffix == ".py" else read_cxx(text)


def find(path: Path, words: list[tuple[re.Pattern[str], str]]) -> Iterator[tuple[int, str, str]]:
    for prose in read(path.read_text(encoding="utf-8"), path.suffix):
        text = blank(r"(`+)(?:[^`\n]|\n(?=.))+?\1", prose.text)
        found = [(match, new) for old, new in words for match in old.finditer(text)]
        head = HEAD.match(text) if prose.has_head else None
        for match, new in found + ([(head, "a noun phrase or a verb")] if head else []):
            place = match.start(1 if match is head else 0)
            yield prose.line + text.count("\n", 0, place), " ".join(match[0].split()), new


def main(arguments: list[str]) -> int:
    words = read_words(Path(__file__).with_name("words.txt"))
    found = [(path, *place) for path in arguments for place in find(Path(path), words)]
    for path, line, old, new in sorted(set(found)):
        print(f'{path}:{line}: "{old}": write "{new}"')
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
