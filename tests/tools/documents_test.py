"""Completion of shells and the manual page, made from the table of options."""
import os
import re
import shutil
import subprocess
import tempfile

from program import COMMANDS, fail, run, skip


def completions(*words):
    """What bash would offer for the last of these words."""
    script = 'source <(cat); COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _rimline; printf "%s\\n" "${COMPREPLY[@]}"'
    with tempfile.TemporaryDirectory() as folder:
        open(os.path.join(folder, "a.obj"), "w").close()
        os.mkdir(os.path.join(folder, "sub"))
        result = subprocess.run(["bash", "-c", script, "bash", *words], input=run("--completion", "bash").stdout, cwd=folder,
                                capture_output=True, text=True, timeout=60)
    assert result.returncode == 0 and result.stderr == "", result.stderr
    return result.stdout.split()


def test_bash_completes_names_of_subcommands_options_and_values():
    if shutil.which("bash") is None:
        skip("bash is not installed")
    assert completions("rimline", "") == list(COMMANDS)
    assert completions("rimline", "ani") == ["animate"]
    assert completions("rimline", "bench", "ho") == ["hough"]
    assert {"--from", "--json", "--quiet", "--subdivide"} <= set(completions("rimline", "silhouette", "--"))
    assert completions("rimline", "silhouette", "a.obj", "--fro") == ["--from"]
    assert completions("rimline", "bench", "fields", "--roun") == ["--rounds"]
    assert completions("rimline", "field", "--weight", "") == ["count", "area"]
    assert completions("rimline", "field", "--weight", "=", "a") == ["area"]
    assert completions("rimline", "info", "") == ["a.obj", "sub"]
    assert completions("rimline", "silhouette", "--from", "") == []
    assert completions("rimline", "batch", "models", "--", "vie") == ["views", "view"]
    assert completions("rimline", "batch", "models", "--", "views", "--styl") == ["--style"]
    assert completions("rimline", "batch", "models", "--", "views", "--style", "bl") == ["blueprint"]


def test_scripts_for_shells_are_well_formed():
    for shell, checks in (("bash", ["bash", "-n"]), ("zsh", ["zsh", "-n"]), ("fish", ["fish", "-n"])):
        script = run("--completion", shell)
        assert script.returncode == 0 and script.stderr == "", script.stderr
        for name in (*COMMANDS, "no-edges", "hough"):
            assert name in script.stdout, (shell, name)
        if shutil.which(checks[0]):
            with tempfile.NamedTemporaryFile("w", suffix="." + shell) as file:
                file.write(script.stdout)
                file.flush()
                found = subprocess.run([*checks, file.name], capture_output=True, text=True, timeout=60)
            assert found.returncode == 0 and found.stderr == "", (shell, found.stderr)
    assert "did you mean 'fish'" in fail(2, "--completion", "fihs")


def test_the_manual_page_has_every_subcommand_and_option():
    page = run("--manual")
    assert page.returncode == 0 and page.stderr == ""
    assert page.stdout.startswith(".TH RIMLINE 1 ")
    plain = page.stdout.replace("\\-", "-")
    for command in COMMANDS:
        assert f"\n.SS rimline {command}\n" in plain, command
        section = plain.split(f"\n.SS rimline {command}\n")[1].split("\n.SS ")[0].split("\n.SH ")[0]
        for option in re.findall(r"^  (?:-\w,)?(--[a-z-]+)", run(command, "--help").stdout, re.MULTILINE):
            assert f"\\fB{option}\\fR" in section, (command, option)
    if shutil.which("groff") is None:
        skip("groff is not installed")
    shown = subprocess.run(["groff", "-k", "-man", "-Tutf8", "-ww"], input=page.stdout, capture_output=True, text=True, timeout=60)
    assert shown.returncode == 0 and shown.stderr == "", shown.stderr
