"""The command inside the package."""

import json
import re
import signal
import subprocess
import sys
import time
import urllib.request
from importlib import metadata
from pathlib import Path

import pytest

import ferry


def command(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-m", "ferry", *arguments], capture_output=True, text=True, timeout=300)


def test_version_and_usage() -> None:
    assert command("--version").stdout == f"ferry {ferry.__version__}\n"
    wrong = command("evaluate", "--episodes", "many")
    assert wrong.returncode != 0 and "--episodes" in wrong.stderr
    missing = command("evaluate", "--map", "nowhere")
    assert missing.returncode == 1 and "nowhere" in missing.stderr


def test_evaluate() -> None:
    done = command("evaluate", "--map", "posts", "--controller", "errt", "--episodes", "4", "--json")
    assert json.loads(done.stdout)["rows"][0]["episodes"] == 4


def test_the_page_is_served_and_an_interrupt_ends_it(tmp_path: Path) -> None:
    serving = subprocess.Popen(
        [sys.executable, "-m", "ferry", "serve", "--bind", "127.0.0.1:0", "--data", str(tmp_path)],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    try:
        address = None
        for line in serving.stdout:
            if found := re.search(r"http://127\.0\.0\.1:\d+", line):
                address = found[0]
                break
        assert address
        page = urllib.request.urlopen(address, timeout=30).read().decode()
        assert "<title>Ferry" in page
        time.sleep(0.5)
        serving.send_signal(signal.SIGINT)
        serving.communicate(timeout=30)
        assert serving.returncode == 0
    finally:
        serving.kill()


def test_the_package_names_its_authors_and_has_the_texts_of_its_licences() -> None:
    package = metadata.distribution("ferry-lab")
    assert package.metadata["Author"] == "The Ferry developers"
    assert package.metadata["License-Expression"] == "MIT OR Apache-2.0"
    files = package.metadata.get_all("License-File") or []
    text = "".join((package.read_text(f"licenses/{file}") or "") for file in files)
    assert "THE SOFTWARE IS PROVIDED" in text and "Apache License" in text


def test_a_missing_argument_is_no_crash() -> None:
    with pytest.raises(TypeError):
        ferry._ferry.run()
