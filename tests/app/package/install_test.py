"""Files copied by `cmake --install` work in their new place: programs, manual pages, completions,
desktop files, and the libraries for a program outside the tree.

    install_test.py BUILD [-v]
"""
import gzip
import json
import os
import pathlib
import pty
import re
import select
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree as ElementTree

BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
SOURCE = pathlib.Path(__file__).resolve().parents[3]
SUBCOMMANDS = ["info", "plan", "edit", "repair", "export", "verify", "view", "statistics",
               "evaluate", "compare", "sweep", "batch", "gather", "generate", "params"]


def run(*command, **options):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True,
                          **options)


def needs(program):
    return unittest.skipUnless(shutil.which(program), f"{program} is not installed")


class InstalledCase(unittest.TestCase):
    """The complete installation, in a temporary prefix that the build does not know."""

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.prefix = cls.folder / "prefix"
        done = run("cmake", "--install", BUILD, "--prefix", cls.prefix)
        assert done.returncode == 0, done.stderr
        cls.share = cls.prefix / "share"
        cls.program = cls.prefix / "bin" / "dollytrack"
        cls.scene = cls.share / "dollytrack" / "scenes" / "apartment.glb"
        cls.has_editor = (cls.prefix / "bin" / "dollytrack-editor").exists()

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()


class Programs(InstalledCase):
    def test_help_of_every_subcommand_works_from_there(self):
        for name in SUBCOMMANDS:
            self.assertEqual(run(self.program, name, "--help").returncode, 0, name)

    def test_version_names_the_commit(self):
        commit = run("git", "-C", SOURCE, "rev-parse", "--short=10", "HEAD").stdout.strip()
        said = run(self.program, "--version").stdout
        self.assertRegex(said, r"^dollytrack \d+\.\d+\.\d+( \(commit [0-9a-f]{10,}(-changed)?\))?\n$")
        if commit and "commit" in said:
            # A build may be older than the last commit, but its commit is in the repository.
            named = re.search(r"commit ([0-9a-f]+)", said)[1]
            self.assertEqual(run("git", "-C", SOURCE, "cat-file", "-t", named).stdout, "commit\n")

    def test_the_example_scene_becomes_a_sound_dataset(self):
        dataset = self.folder / "dataset"
        environment = {"PATH": "/usr/bin:/bin", "HOME": str(self.folder)}
        done = run(self.program, "export", self.scene, "--out", dataset, "--max-frames", 12,
                   "--set", "width_px=160", "--set", "height_px=120", env=environment)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(list((dataset / "rgb").glob("*.png"))), 12)
        done = run(self.program, "verify", dataset, env=environment)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_judges_are_found(self):
        said = run(self.program, "compare", "--outcomes", "odometry", "--list")
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertIn("odometry", said.stdout)

    def test_the_links_of_the_guides_lead_to_files(self):
        guides = self.share / "doc" / "dollytrack" / "guides"
        links = [(guide, link) for guide in guides.glob("*.md")
                 for link in re.findall(r"\]\(([^)#]+)", guide.read_text())
                 if not link.startswith("http")]
        self.assertGreater(len(links), 50)
        self.assertEqual([f"{guide.name}: {link}" for guide, link in links
                          if not (guide.parent / link).is_file()], [])

    def test_no_file_names_the_source_or_the_build_folder(self):
        for file in filter(pathlib.Path.is_file, self.prefix.rglob("*")):
            content = file.read_bytes()
            if file.suffix == ".gz":
                content = gzip.decompress(content)
            for folder in (BUILD, SOURCE):
                self.assertNotIn(bytes(folder) + b"/", content, file)

    def test_an_unwritable_folder_for_the_manual_is_named(self):
        done = run(self.program, "--write-manual", "/proc/nothing")
        self.assertEqual(done.returncode, 6)
        self.assertRegex(done.stderr, r"^dollytrack: /proc/nothing/\S+: cannot be written")


class ManualPages(InstalledCase):
    def pages(self):
        return sorted((self.share / "man" / "man1").glob("*.1.gz"))

    def test_every_subcommand_has_one(self):
        wanted = {"dollytrack"} | {f"dollytrack-{name}" for name in SUBCOMMANDS}
        if self.has_editor:
            wanted.add("dollytrack-editor")
        self.assertEqual({page.name[:-5] for page in self.pages()}, wanted)

    @needs("groff")
    def test_groff_warns_of_nothing(self):
        for page in self.pages():
            done = subprocess.run(["groff", "-man", "-Tutf8", "-ww", "-z"],
                                  input=gzip.decompress(page.read_bytes()), capture_output=True)
            self.assertEqual((done.returncode, done.stderr), (0, b""), page)

    @needs("mandoc")
    def test_mandoc_finds_no_error(self):
        for page in self.pages():
            plain = self.folder / page.stem
            plain.write_bytes(gzip.decompress(page.read_bytes()))
            done = run("mandoc", "-Tlint", "-Werror", plain)
            self.assertEqual((done.returncode, done.stdout), (0, ""), page)

    @needs("groff")
    def test_they_have_every_option_with_the_text_of_help(self):
        for name in SUBCOMMANDS:
            page = self.share / "man" / "man1" / f"dollytrack-{name}.1.gz"
            shown = subprocess.run(["groff", "-man", "-Tutf8", "-P-cbou", "-rLL=5000n", "-rHY=0"],
                                   input=gzip.decompress(page.read_bytes()),
                                   capture_output=True).stdout.decode()
            shown = " ".join(shown.split())
            lines = run(self.program, name, "--help").stdout.splitlines()
            begin = lines.index("Options:") + 1
            end = lines.index("", begin)
            for word in " ".join(lines[begin:end]).split():
                self.assertIn(word, shown, name)

    def test_the_parameters_are_those_of_set(self):
        page = gzip.decompress((self.share / "man/man1/dollytrack-params.1.gz").read_bytes()).decode()
        sections = json.loads(run(self.program, "params", "--json").stdout)
        for section, fields in sections.items():
            for name in fields:
                self.assertIn(f"\\fB{name}\\fR=", page, section)


class Completions(InstalledCase):
    def bash(self, line):
        """Completions that bash offers at the end of a line, which is split as readline splits
        it."""
        words = re.findall(r"=|[^\s=]+", line)
        if line.endswith(" "):
            words.append("")
        script = self.share / "bash-completion/completions/dollytrack"
        quoted = " ".join(f"'{word}'" for word in words)
        done = run("bash", "-c", f". {script}; COMP_WORDS=({quoted}); COMP_CWORD={len(words) - 1}; "
                                 '_dollytrack; printf "%s\\n" "${COMPREPLY[@]}"',
                   cwd=self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""), line)
        return done.stdout.split()

    def test_scripts_are_sound(self):
        for shell, file in (("bash", "bash-completion/completions/dollytrack"),
                            ("zsh", "zsh/vendor-completions/_dollytrack"),
                            ("fish", "fish/vendor_completions.d/dollytrack.fish")):
            if shutil.which(shell):
                done = run(shell, "-n", self.share / file)
                self.assertEqual((done.returncode, done.stderr), (0, ""), shell)

    def test_bash_completes_subcommands_options_and_values(self):
        (self.folder / "room.glb").touch()
        (self.folder / "rooms").mkdir(exist_ok=True)
        for line, wanted in (("dollytrack pl", ["plan"]),
                             ("dollytrack plan --max-f", ["--max-frames"]),
                             ("dollytrack plan room.glb --gl ", ["auto", "egl", "osmesa"]),
                             ("dollytrack plan --gl=os", ["osmesa"]),
                             ("dollytrack --progress js", ["json"]),
                             ("dollytrack plan --set max_fram", ["max_frames="]),
                             ("dollytrack plan --set loop=", ["true", "false"]),
                             ("dollytrack plan --set loop=tr", ["true"]),
                             ("dollytrack plan --set max_frames=3 --lo", ["--loop"]),
                             ("dollytrack export x --modalities rgb,dis", ["rgb,disparity"]),
                             ("dollytrack plan room", ["room.glb", "rooms"]),
                             ("dollytrack verify room", ["rooms"]),
                             ("dollytrack plan --planner tw", ["two-body"])):
            self.assertEqual(sorted(self.bash(line)), sorted(wanted), line)

    def test_bash_offers_every_option_and_parameter(self):
        for name in SUBCOMMANDS:
            shown = re.findall(r"(?<![\w-])--[a-z][\w-]*",
                               run(self.program, name, "--help").stdout.split("Options:")[1]
                               .split("\n\n")[0])
            offered = self.bash(f"dollytrack {name} --")
            self.assertLessEqual({word for word in shown if word != "--op"}, set(offered) | {
                # Named in the texts of other options.
                "--list", "--picture", "--out", "--estimated", "--outcomes", "--json"}, name)
        offered = {word.split("=")[0] for word in self.bash("dollytrack sweep --set ")}
        sections = json.loads(run(self.program, "params", "--json").stdout)
        self.assertLessEqual({name for fields in sections.values() for name in fields}, offered)

    def test_bash_completes_what_is_typed(self):
        script = self.share / "bash-completion/completions/dollytrack"
        process, terminal = pty.fork()
        if process == 0:
            os.execvpe("bash", ["bash", "--norc", "--noprofile", "-i"],
                       {"PS1": "> ", "TERM": "dumb", "PATH": f"{self.program.parent}:/usr/bin:/bin",
                        "INPUTRC": "/dev/null", "HOME": str(self.folder)})
        os.write(terminal, f". {script}\n".encode())
        # Each Tab completes; Enter runs the line, and echo returns its words.
        os.write(terminal, b"dollytrack() { echo \"<$*>\"; }\n")
        os.write(terminal, b"dollytrack sw\troom.glb --met\tx --set max_fram\t7 --set loop=tr\t\n")
        os.write(terminal, b"exit\n")
        said = b""
        deadline = time.time() + 60
        while time.time() < deadline:
            if not select.select([terminal], [], [], 1)[0]:
                continue
            try:
                said += os.read(terminal, 65536)
            except OSError:
                break
        os.waitpid(process, 0)
        os.close(terminal)
        self.assertIn(b"<sweep room.glb --metric x --set max_frames=7 --set loop=true>", said)

    @needs("fish")
    def test_fish_completes_subcommands_options_and_values(self):
        script = self.share / "fish/vendor_completions.d/dollytrack.fish"
        for line, wanted in (("dollytrack pl", "plan"), ("dollytrack plan --max-f", "--max-frames"),
                             ("dollytrack plan --gl os", "osmesa"),
                             ("dollytrack plan --set max_fram", "max_frames="),
                             ("dollytrack export --modalities rgb,dis", "rgb,disparity")):
            done = run("fish", "--no-config", "-c", f"source {script}; complete -C '{line}'",
                       env=dict(os.environ, HOME=str(self.folder)))
            self.assertIn(wanted, [row.split("\t")[0] for row in done.stdout.splitlines()], line)

    @needs("zsh")
    def test_zsh_completes_subcommands_options_and_values(self):
        functions = self.share / "zsh/vendor-completions"
        for line, wanted in (("dollytrack swe", "dollytrack sweep "),
                             ("dollytrack plan --max-f", "dollytrack plan --max-frames="),
                             ("dollytrack plan --gl os", "dollytrack plan --gl osmesa "),
                             ("dollytrack plan --set max_fram",
                              "dollytrack plan --set max_frames=")):
            # A shell inside a shell, whose line is printed once Tab has completed it.
            script = f"""
                zmodload zsh/zpty
                zpty inner zsh -f -i
                zpty -w inner "PS1=; fpath=({functions} \\$fpath); autoload -Uz compinit"
                zpty -w inner "compinit -u -d {self.folder}/dump"
                zpty -w inner "show() {{ print -r \\"<\\$BUFFER>\\"; exit }}; zle -N show; bindkey ^X show"
                zpty -w -n inner $'{line}\\t\\x18'
                local text all
                while zpty -r inner text; do all+=$text; done
                print -r -- $all"""
            done = run("zsh", "-f", "-c", script, timeout=120,
                       env=dict(os.environ, TERM="dumb", HOME=str(self.folder)))
            self.assertIn(f"<{wanted}>", done.stdout, line)


class Desktop(InstalledCase):
    def setUp(self):
        if not self.has_editor:
            self.skipTest("built without the editor")

    @needs("desktop-file-validate")
    def test_the_desktop_file_is_valid(self):
        done = run("desktop-file-validate", self.share / "applications/dollytrack-editor.desktop")
        self.assertEqual((done.returncode, done.stdout), (0, ""))

    @needs("appstreamcli")
    def test_the_appstream_data_are_valid(self):
        done = run("appstreamcli", "validate", "--no-net",
                   self.share / "metainfo/org.dollytrack.editor.metainfo.xml")
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_names_in_the_files_agree(self):
        desktop = (self.share / "applications/dollytrack-editor.desktop").read_text()
        mime = ElementTree.parse(self.share / "mime/packages/dollytrack-editor.xml").getroot()
        kind = mime[0].get("type")
        self.assertIn(f"MimeType={kind};", desktop)
        metainfo = ElementTree.parse(
            self.share / "metainfo/org.dollytrack.editor.metainfo.xml").getroot()
        self.assertTrue((self.share / "applications" / metainfo.findtext("launchable")).exists())
        icon = re.search(r"^Icon=(.*)$", desktop, re.M)[1]
        self.assertTrue((self.share / f"icons/hicolor/scalable/apps/{icon}.svg").exists())
        version = run(self.program, "--version").stdout.split()[1]
        self.assertEqual(metainfo.find("releases/release").get("version"), version)
        changelog = (SOURCE / "app/packaging/changelog").read_text()
        self.assertTrue(changelog.startswith(f"dollytrack ({version}) "))

    @needs("update-mime-database")
    def test_projects_have_our_type(self):
        shutil.copytree(self.share / "mime", self.folder / "data/mime")
        self.assertEqual(run("update-mime-database", self.folder / "data/mime").returncode, 0)
        globs = (self.folder / "data/mime/globs2").read_text()
        self.assertIn(":application/x-dollytrack:*.dolly\n", globs)


class Libraries(InstalledCase):
    def test_a_program_outside_the_tree_plans_and_renders(self):
        example = self.folder / "example"
        shutil.copytree(SOURCE / "tests/app/package/example", example)
        done = run("cmake", "-S", example, "-B", example / "build", "-G", "Ninja",
                   f"-DCMAKE_PREFIX_PATH={self.prefix}")
        self.assertEqual(done.returncode, 0, done.stderr)
        done = run("cmake", "--build", example / "build")
        self.assertEqual(done.returncode, 0, done.stdout)
        done = run(example / "build/plan_room", self.scene, self.folder / "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        captured, objects, frames = map(int, re.findall(r"\d+", done.stdout))
        self.assertEqual((objects, frames), (250, 8))
        self.assertGreater(captured, 10)
        self.assertEqual(len(list((self.folder / "out/rgb").glob("*.png"))), 8)


if __name__ == "__main__":
    unittest.main()
