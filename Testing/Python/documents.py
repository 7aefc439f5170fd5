"""Parser of the documentation's pages: code blocks, links, anchors."""

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
NOT_OURS = {"build", ".git", "node_modules"}

FENCE = re.compile(r"^```([^\n]*)\n(.*?)^```[ \t]*$", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"!?\[[^][]*\]\(([^()\s]+)\)")
HEADING = re.compile(r"^#{1,6} +(.*?) *$", re.MULTILINE)


def pages(root=ROOT):
    found = (path.relative_to(root) for path in root.rglob("*.md"))
    return sorted(path for path in found if not NOT_OURS & set(path.parts))


def blocks(text):
    return [(language.strip(), body) for language, body in FENCE.findall(text)]


def prose(text):
    """The page without its code."""
    return re.sub(r"`[^`\n]*`", "``", FENCE.sub("", text))


def links(text):
    return [target for line in [FENCE.sub("", text)] for target in LINK.findall(_linked(line))]


def _linked(text):
    """Removes brackets and parentheses from code: code has no links, but a link's text may have
    code."""
    return re.sub(r"`([^`\n]*)`", lambda code: re.sub(r"[][()]", "", code[1]), text)


def anchors(text):
    """Anchors (#...) of this page, derived from the headings as on GitHub."""
    found = []
    for heading in HEADING.findall(FENCE.sub("", text)):
        plain = re.sub(r"\[([^][]*)\]\([^()]*\)", r"\1", heading).replace("`", "").lower()
        slug = re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")
        again = sum(other == slug or other.startswith(slug + "-n") for other in found)
        found.append(slug if not again else f"{slug}-n{again}")
    return {re.sub(r"-n(\d+)$", r"-\1", slug) for slug in found}


def broken_links(root=ROOT):
    """'page: target' of each link to a missing file or heading."""
    broken = []
    for page in pages(root):
        for target in links((root / page).read_text(encoding="utf-8")):
            if re.match(r"https?://", target):
                continue
            name, _, anchor = target.partition("#")
            file = (root / page).parent / name if name else root / page
            leads = file.exists() and (
                not anchor
                or (file.suffix == ".md" and anchor in anchors(file.read_text(encoding="utf-8")))
            )
            if not leads:
                broken.append(f"{page}: {target}")
    return broken


def reached(start, root=ROOT):
    seen, todo = set(), [(root / start).resolve()]
    while todo:
        page = todo.pop()
        if page in seen or page.suffix != ".md" or not page.exists():
            continue
        seen.add(page)
        for target in links(page.read_text(encoding="utf-8")):
            todo.append((page.parent / target.partition("#")[0]).resolve())
    return {page.relative_to(root.resolve()) for page in seen}


def commands(body):
    lines = re.sub(r"\\\n", " ", body).splitlines()
    plain = (re.sub(r"(^|\s)#.*$", "", line).strip() for line in lines)
    return [part.strip() for line in plain if line for part in line.split("&&")]
