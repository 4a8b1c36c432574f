"""Completion of shells and the manual page, made from the table of options."""
import os
import re
import shutil
import subprocess
import tempfile

from program import COMMANDS, fail, have_device, run, skip


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
    # Names beside other values.
    assert completions("rimline", "convert", "--up", "-") == ["-x", "-y", "-z"]


def test_bash_completes_names_that_pictures_take_beside_other_values():
    if shutil.which("bash") is None:
        skip("bash is not installed")
    assert completions("rimline", "points", "--eye", "") == ["front", "back", "left", "right", "top", "bottom", "three-quarter"]
    have_device()
    assert completions("rimline", "render", "--eye", "f") == ["front"]
    assert completions("rimline", "render", "--eye", "au") == ["auto"]
    assert {"material", "maroon"} <= set(completions("rimline", "render", "--line-color", "m"))
    assert {"none", "navy"} <= set(completions("rimline", "views", "--background", "n"))
    palettes = completions("rimline", "animate", "--palette", "")
    assert "sepia" in palettes and len(set(palettes)) == len(palettes), palettes


def shell_completions(shell, *words):
    """What zsh or fish is told to offer for the last of these words, in lines."""
    if shutil.which(shell) is None:
        skip(f"{shell} is not installed")
    if shell == "zsh":
        # The script completes when it is read: with the words that the shell sets.
        commands = """_arguments() { print -l -- "$@" }; _describe() { print -l -- "${(P@)2}" }
                      words=("$@"); CURRENT=$#; source /dev/stdin"""
        command = ["zsh", "-f", "-c", commands, "zsh", *words]
    else:
        command = ["fish", "--no-config", "-c", 'source -; complete -C "$argv"', *words]
    result = subprocess.run(command, input=run("--completion", shell).stdout, capture_output=True, text=True, timeout=60)
    assert result.returncode == 0 and result.stderr == "", result.stderr
    return result.stdout.splitlines()


def check_completions(shell):
    def begins(text, *words):
        return any(line.startswith(text) for line in shell_completions(shell, *words))

    views, style = ("views:", "*--style[") if shell == "zsh" else ("views\t", "--style\t")
    assert begins(views, "rimline", "vie")
    assert begins(style, "rimline", "views", "a.obj", "--sty")
    assert begins(views, "rimline", "batch", "models", "--", "vie")
    assert begins(style, "rimline", "batch", "models", "--", "views", "--sty")
    assert not begins(style, "rimline", "batch", "models", "--sty")


def test_zsh_completes_names():
    check_completions("zsh")
    names = [line for line in shell_completions("zsh", "rimline", "convert", "--up", "") if line.startswith("*--up[")]
    assert len(names) == 1 and names[0].endswith(":(x -x y -y z -z auto)"), names


def test_fish_completes_names():
    check_completions("fish")
    names = shell_completions("fish", "rimline", "convert", "--up", "")
    assert {name.split("\t")[0] for name in names} == {"x", "-x", "y", "-y", "z", "-z", "auto"}, names


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
