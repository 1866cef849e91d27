"""Every verb of the command as a function."""
import ast
import inspect
import json
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import bake
from bake import arrays


def verbs_of_the_command(command):
    text = subprocess.run([command, "--help"], check=True, capture_output=True, text=True).stdout
    lines = text.partition("Subcommands:\n")[2].partition("\n\n")[0].splitlines()
    return [line.split()[0].replace("-", "_") for line in lines if line[2] != " "]


def test_every_verb_is_a_function_with_the_options_of_the_command(command):
    verbs = verbs_of_the_command(command)
    assert len(verbs) >= 10
    for verb in verbs:
        function = getattr(bake, verb)
        text = subprocess.run([command, verb.replace("_", "-"), "--help"], check=True, capture_output=True,
                              text=True).stdout
        for name in inspect.signature(function).parameters:
            if name not in ("inputs", "progress"):
                assert "--" + name.rstrip("_").replace("_", "-") in text, (verb, name)
        assert function.__doc__


def test_stubs_have_the_functions_of_the_module():
    folder = Path(bake.__file__).parent
    for name, module in (("__init__", bake), ("arrays", arrays)):
        tree = ast.parse((folder / f"{name}.pyi").read_text())
        stubs = {node.name for node in tree.body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}
        assert stubs == {n for n in module.__all__ if callable(getattr(module, n))} - {"Error"}
    for function in ast.parse((folder / "__init__.pyi").read_text()).body:
        if isinstance(function, ast.FunctionDef):
            stub = [argument.arg for argument in function.args.kwonlyargs]
            assert ["inputs", *stub] == list(inspect.signature(getattr(bake, function.name)).parameters)


def test_results_and_files_are_those_of_the_command(command, meshes, tmp_path):
    height = meshes / "bricks.png"
    ours = bake.normal_map(meshes / "torus.obj", height=height, amplitude="1%", size=(64, 32), out=tmp_path / "ours.png")
    line = [command, "normal-map", meshes / "torus.obj", "--height", height, "--amplitude", "1%", "--size", "64x32",
            "-o", tmp_path / "theirs.png", "--json"]
    theirs = json.loads(subprocess.run(line, check=True, capture_output=True).stdout)
    for result in (ours, theirs):
        for key in ("seconds", "memory", "argv", "outputs", "out"):
            result.pop(key, None)
    assert ours == theirs
    assert np.array_equal(arrays.read_image(tmp_path / "ours.png"), arrays.read_image(tmp_path / "theirs.png"))


def test_jpeg_is_read_by_the_helper_program(meshes):
    result = bake.check(meshes.parent / "tests/data/dots.jpg")
    assert "16" in json.dumps(result)


def test_refusals_name_the_file_and_the_exit_code(meshes, tmp_path, monkeypatch):
    missing = tmp_path / "none.png"
    with pytest.raises(bake.Error) as caught:
        bake.normal_map(missing, out=tmp_path / "out.png")
    assert caught.value.exit_code == 3
    assert caught.value.file == str(missing)
    assert str(caught.value).startswith(str(missing))
    with pytest.raises(bake.Error) as caught:
        bake.bump_table(meshes / "bricks.png", out=tmp_path / "no/out.exr")
    assert caught.value.exit_code == 5
    with pytest.raises(bake.Error) as caught:
        bake.bump_table(meshes / "bricks.png", out=tmp_path / "out.exr", filter="none")
    assert caught.value.exit_code == 2 and caught.value.file is None
    with pytest.raises(TypeError, match="amplitud"):
        bake.bump_table(meshes / "bricks.png", out=tmp_path / "out.exr", amplitud=1)
    assert os.listdir(tmp_path) == []


def test_a_result_over_its_limit_is_raised_with_the_result(meshes):
    with pytest.raises(bake.Error) as caught:
        bake.compare(meshes / "torus.obj", meshes / "sphere.obj", limit="distance=0.001")
    assert caught.value.exit_code == 1
    assert isinstance(caught.value.result, dict) and caught.value.result


def test_progress_is_told_and_what_it_raises_ends_the_work(meshes, tmp_path):
    told = []
    bake.render(meshes / "torus.obj", out=tmp_path / "torus.png", size=64, spp=64,
                progress=lambda step, done, total: told.append((step, done, total)))
    assert told and all(isinstance(step, str) and 0 <= done <= max(done, total) for step, done, total in told)

    told.clear()
    bake.normal_map(meshes / "torus.obj", high=meshes / "torus.obj", out=tmp_path / "cast.png", size=1024, rays=8,
                    progress=lambda *news: told.append(news))
    assert any(step == "bake" and 0 < done < total for step, done, total in told)

    class Enough(Exception):
        pass

    def stop(step, done, total):
        raise Enough(step)

    start = time.monotonic()
    with pytest.raises(Enough):
        bake.render(meshes / "torus.obj", out=tmp_path / "few.png", size=512, spp=4096, progress=stop)
    with pytest.raises(Enough):
        bake.normal_map(meshes / "torus.obj", high=meshes / "torus.obj", out=tmp_path / "never.png", size=4096, rays=8,
                        progress=stop)
    assert time.monotonic() - start < 30
    assert not (tmp_path / "never.png").exists()


def test_the_gil_is_released(meshes, tmp_path):
    work = threading.Thread(target=bake.render, args=[meshes / "torus.obj"],
                            kwargs={"out": tmp_path / "torus.png", "size": 128, "spp": 64})
    work.start()
    turns = 0
    while work.is_alive():
        turns += 1
        time.sleep(0.001)
    work.join()
    assert turns > 20


def test_verbs_run_on_several_threads(meshes, tmp_path):
    def work(i):
        bake.normal_map(meshes / "bricks.png", out=tmp_path / f"{i}.png", threads=1)

    threads = [threading.Thread(target=work, args=[i]) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len({(tmp_path / f"{i}.png").read_bytes() for i in range(4)}) == 1


interrupted_script = """
import sys
import bake
try:
    print("begin", flush=True)
    {call}
except KeyboardInterrupt:
    print("interrupted", flush=True)
    bake.bump_table({bricks!r}, out={again!r})  # the next one runs
    sys.exit(7)
"""


@pytest.mark.parametrize("call, files", [
    # A rendering is written with the samples that it has.
    ("bake.render({torus!r}, out={out!r}, size=1024, spp=65536)", ["again.exr", "out.png"]),
    ("bake.arrays.prefilter([__import__('numpy').ones((1024, 1024, 3), 'f')] * 6, [.3] * 6)", ["again.exr"]),
])
def test_ctrl_c_is_a_keyboard_interrupt(meshes, tmp_path, call, files):
    out, again = tmp_path / "out.png", tmp_path / "again.exr"
    call = call.format(torus=str(meshes / "torus.obj"), out=str(out))
    script = interrupted_script.format(call=call, bricks=str(meshes / "bricks.png"), again=str(again))
    process = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "begin\n"
    time.sleep(1)
    process.send_signal(signal.SIGINT)
    text, _ = process.communicate(timeout=120)
    assert text == "interrupted\n" and process.returncode == 7
    assert sorted(os.listdir(tmp_path)) == files
