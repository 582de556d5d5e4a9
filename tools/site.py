#!/usr/bin/env python3
"""Builds dist/site: papers, course, gallery, every predicate, and the playground if it was built.

    tools/site.py            after `make doc`; `make site` does both

A folder for any web server, which works from a disk as well: the search is a script in it. The
generator is Material for MkDocs, in an environment of its own in target/site.
"""

import html
import os
import re
import shutil
import subprocess
import sys
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
WORK = ROOT / "target/site"
PAGES = WORK / "pages"
SITE = ROOT / "dist/site"

CHAPTERS = [
    ("worlds", "Worlds and the simulator"), ("reactive", "Robots that react"), ("layers", "Layers: a controller over time"),
    ("reasoning", "See Prolog think"),
    ("cognitive-robotics", "Golog"), ("localization", "Where am I?"), ("view", "The live view"),
    ("playground", "The playground"), ("brick", "On the brick"), ("safety", "Safety"),
    ("coming-from", "Coming from another system"), ("performance", "How fast it is"),
    ("checked", "What was checked"), ("ev3dev-sysfs", "The files of ev3dev"),
    ("view-protocol", "The protocol of the view"),
]

LINK = re.compile(r"(!?\[[^\]]*\])\(([^)\s]+)\)")


def course():
    """The folders of the exercises, in their order."""
    return sorted(path.parent for path in ROOT.glob("course/*/task.md"))


def page_of(path):
    """Where in the site a file of the project is: its page, or its copy."""
    if path == ROOT / "README.md":
        return "index.md"
    if path.suffix == ".md" and path.parent == ROOT / "docs":
        return f"docs/{path.name}"
    if path.suffix == ".md":
        return f"more/{path.relative_to(ROOT)}"
    if path.is_file():
        return f"files/{path.relative_to(ROOT)}"
    return None


def written(page, text):
    """Writes a page, and answers its path."""
    path = PAGES / page
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


def up(page):
    """From a page to the root of the site."""
    return "../" * page.count("/")


def moved(source, todo):
    """The text of a paper of the project, with links to where the site has things."""
    page = page_of(source)

    def link(match):
        text, target = match.groups()
        if re.match(r"[a-z]+:|#", target):
            return match.group(0)
        name, _, fragment = target.partition("#")
        found = (source.parent / name).resolve()
        there = page_of(found) if found.exists() else None
        if there is None:
            return text.strip("![]") if not text.startswith("!") else ""
        todo.append(found)
        return f"{text}({up(page)}{there}{'#' + fragment if fragment else ''})"

    return LINK.sub(link, source.read_text(encoding="utf-8"))


def papers():
    """The papers of the project, and what they name."""
    todo, done = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md")),
                  *(folder / "task.md" for folder in course())], set()
    while todo:
        path = todo.pop()
        if path in done:
            continue
        done.add(path)
        if path.suffix == ".md":
            text = moved(path, todo)
            if path.parent in course():
                text += "\n## The skeleton\n\n" + code(path.parent / "skeleton.pl")
            written(page_of(path), text)
        else:
            copy = PAGES / page_of(path)
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, copy)


def code(path):
    """A program in a page."""
    return f"```prolog\n{path.read_text(encoding='utf-8')}```\n"


def gallery():
    """A film of each example that has one, with its program."""
    parts = ["# Gallery\n\nWhat the examples do in the simulator, ten times as fast. They are in the "
             "pack: `swipl ev3dev run NAME --world room`.\n"]
    for film in sorted((ROOT / "docs/pictures").glob("film-*.svg")):
        name = film.stem.removeprefix("film-")
        copy = PAGES / "docs/pictures" / film.name
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(film, copy)
        example = code(ROOT / f"examples/{name}.pl").replace("\n", "\n    ").rstrip()
        parts.append(f"## {name}\n\n![What {name} does](docs/pictures/{film.name}){{ width=480 }}\n\n"
                     f"??? example \"{name}.pl\"\n\n    {example}\n")
    written("gallery.md", "\n".join(parts))


def reference():
    """PlDoc's pages; their links among each other stay what they are."""
    names = []
    for source in sorted((ROOT / "doc").glob("*.html")):
        text = source.read_text(encoding="utf-8")
        title = html.unescape(re.search(r"<title>(.*?)</title>", text, re.S).group(1)).strip()
        title = title.removeprefix("ev3dev/").removesuffix(".pl")
        body = re.search(r"<body[^>]*>(.*)</body>", text, re.S).group(1)
        # A line without text would end a block of HTML in Markdown.
        body = re.sub(r"\n\s*(?=\n)", "\n", re.sub(
            r"(<pre[^>]*>)(.*?)(</pre>)",
            lambda m: m[1] + re.sub(r"\n[ \t]*(?=\n)", "\n&#8203;", m[2]) + m[3], body, flags=re.S))
        name = "index.md" if source.name == "index.html" else f"{source.stem}.md"
        written(f"reference/{name}", f"---\ntitle: \"{title}\"\nsearch: {{boost: 3}}\n---\n\n<div class=\"pldoc\">\n{body}\n</div>\n")
        names.append((source.stem, title))
    for other in (ROOT / "doc").iterdir():
        if other.suffix in {".svg", ".css", ".png", ".gif"}:
            shutil.copyfile(other, PAGES / "reference" / other.name)
    return names


STYLE = """\
.pldoc dt.pubdef, .pldoc dt.multidef { background: var(--md-code-bg-color); padding: .2rem .5rem;
  border-radius: .2rem; margin-top: 1rem }
.pldoc .defbody, .pldoc dd { margin-left: 1rem }
.pldoc .file-header, .pldoc .undoc { color: var(--md-default-fg-color) }
.pldoc var { font-style: italic }
.pldoc pre { background: var(--md-code-bg-color); padding: .5rem; overflow-x: auto }
.pldoc table { font-size: .7rem }
img[src$=".svg"] { background: #ebebeb }
"""


def config(names):
    """mkdocs.yml"""
    lines = [
        "site_name: ev3dev for SWI-Prolog", f"docs_dir: {PAGES}", f"site_dir: {SITE}",
        "use_directory_urls: false", "extra_css: [site.css]", "theme:", "  name: material",
        "  font: false", "  features: [navigation.indexes, navigation.top, content.code.copy, toc.follow]",
        "  palette:",
        "    - {media: '(prefers-color-scheme: light)', scheme: default, toggle: {icon: material/weather-night, name: Dark}}",
        "    - {media: '(prefers-color-scheme: dark)', scheme: slate, toggle: {icon: material/weather-sunny, name: Light}}",
        "plugins: [search, offline]", "markdown_extensions:",
        "  - tables", "  - attr_list", "  - admonition", "  - pymdownx.details",
        "  - pymdownx.superfences", "  - pymdownx.highlight", "  - toc: {permalink: true}",
        "validation: {links: {not_found: warn, anchors: warn, unrecognized_links: ignore}, nav: {omitted_files: ignore}}",
        "nav:", "  - Start: index.md", "  - The first afternoon: docs/first-afternoon.md", "  - Course:",
        "    - Teaching: docs/teaching.md", "    - Exercises and marks: docs/marking.md",
    ]
    for folder in course():
        title = (folder / "task.md").read_text(encoding="utf-8").splitlines()[0].lstrip("# ")
        lines.append(f"    - \"{title}\": {page_of(folder / 'task.md')}")
    lines.append("  - Gallery: gallery.md")
    lines.append("  - Chapters:")
    lines += [f"    - \"{title}\": docs/{name}.md" for name, title in CHAPTERS]
    lines += ["  - Predicates:", "    - reference/index.md", "    - All on one page: docs/predicates.md"]
    lines += [f"    - \"{title}\": reference/{name}.md" for name, title in names if name != "index"]
    return "\n".join(lines) + "\n"


def generator():
    """mkdocs, installed where it is not."""
    home = WORK / "tools"
    wanted = (ROOT / "tools/site/requirements.txt").read_text()
    stamp = home / "requirements.txt"
    if not stamp.exists() or stamp.read_text() != wanted:
        venv.create(home, with_pip=True, clear=True)
        subprocess.run([home / "bin/pip", "install", "-q", "-r", ROOT / "tools/site/requirements.txt"],
                       check=True)
        stamp.write_text(wanted)
    return home / "bin/mkdocs"


def local_worker():
    """The search's worker, of which a page from a disk has none, comes from the site itself."""
    subprocess.run([ROOT / "tools/modules.sh", "tools/site", WORK / "modules"], check=True)
    shutil.copyfile(WORK / "modules/node_modules/iframe-worker/shim/index.js", SITE / "assets/worker.js")
    for page in SITE.rglob("*.html"):
        text = page.read_text(encoding="utf-8")
        here = "../" * len(page.relative_to(SITE).parent.parts)
        page.write_text(text.replace("https://unpkg.com/iframe-worker/shim", f"{here}assets/worker.js"),
                        encoding="utf-8")


def main():
    """Builds the site."""
    mkdocs = generator()
    shutil.rmtree(PAGES, ignore_errors=True)
    papers()
    gallery()
    names = reference()
    written("site.css", STYLE)
    (WORK / "mkdocs.yml").write_text(config(names), encoding="utf-8")
    run = subprocess.run([mkdocs, "build", "--quiet", "--strict", "-f", WORK / "mkdocs.yml"],
                         capture_output=True, text=True, check=False,
                         env={**os.environ, "NO_MKDOCS_2_WARNING": "1"})
    sys.stderr.write(run.stderr)
    if run.returncode:
        sys.exit(1)
    local_worker()
    if (ROOT / "dist/playground/parts.bin").exists():
        shutil.copytree(ROOT / "dist/playground", SITE / "playground")
    files = [path for path in SITE.rglob("*") if path.is_file()]
    print(f"dist/site: {len(files)} files, {sum(f.stat().st_size for f in files) / 1e6:.1f} MB")


if __name__ == "__main__":
    main()
