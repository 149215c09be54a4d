# SPDX-License-Identifier: MIT OR Apache-2.0
"""A film of saved pictures."""
import glob
import os
import shutil
import subprocess
import tempfile

from .arguments import needed, positive
from .files import written

_OF_GIF, _OF_FFMPEG = (".gif", ), (".mp4", ".webm", ".mkv")


def movie(file, pictures, fps=12):
    """Makes a film of pictures of one size, as plot() writes them.

    file: .gif, written by Pillow, or .mp4, .webm, .mkv, for which the program ffmpeg must be installed. pictures: a
    list of files, or a pattern such as "out/pile_*.png", whose files are taken in the order of their names. fps:
    pictures a second. The file is written whole or not at all. ValueError for no pictures, pictures of several sizes
    and other endings.
    """
    ending = os.path.splitext(os.fspath(file))[1].lower()
    if ending not in _OF_GIF + _OF_FFMPEG:
        raise ValueError(f"{file}: a film is written as {', '.join(_OF_GIF + _OF_FFMPEG)}: "
                         "give the file one of these endings")
    fps = positive(fps, "fps")
    names = sorted(glob.glob(pictures)) if isinstance(pictures, str) else [os.fspath(one) for one in pictures]
    if not names:
        raise ValueError(f"pictures={pictures!r}: there is no such file")
    image = needed("PIL.Image", "Pillow")
    sizes = {}
    for name in names:
        with image.open(name) as opened:
            sizes.setdefault(opened.size, name)
    if len(sizes) > 1:
        (one, first), (other, second) = list(sizes.items())[:2]
        raise ValueError(f"{first} has {one[0]} x {one[1]} pixels, {second} {other[0]} x {other[1]}: "
                         "give pictures of one size")
    if ending in _OF_GIF:
        frames = [image.open(name).convert("RGB").quantize(256, dither=0) for name in names]
        with written(file) as out:
            frames[0].save(out, format="GIF", save_all=True, append_images=frames[1:], duration=round(1000 / fps),
                           loop=0)
    else:
        _by_ffmpeg(file, ending, [os.path.abspath(name) for name in names], fps)


def _by_ffmpeg(file, ending, names, fps):
    if not shutil.which("ffmpeg"):
        raise RuntimeError(f"{file} needs the program ffmpeg: apt install ffmpeg, or give the film the ending .gif")
    with tempfile.TemporaryDirectory() as folder:
        for number, name in enumerate(names):
            os.symlink(name, os.path.join(folder, f"{number:06d}{os.path.splitext(name)[1]}"))
        made = os.path.join(folder, "film" + ending)
        # Encoders take even sizes alone.
        done = subprocess.run(["ffmpeg", "-y", "-loglevel", "error", "-framerate", f"{fps:g}", "-i",
                               os.path.join(folder, "%06d" + os.path.splitext(names[0])[1]), "-vf",
                               "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", made],
                              capture_output=True, text=True, stdin=subprocess.DEVNULL)
        if done.returncode:
            raise RuntimeError(f"{file}: ffmpeg says: {done.stderr.strip()[-300:]}")
        with open(made, "rb") as film, written(file) as out:
            shutil.copyfileobj(film, out)
