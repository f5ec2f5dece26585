"""A client of metamerd, the spectral render service: pictures and spectra as numpy arrays.

    import metamer

    with metamer.local() as server:                 # or metamer.connect("tls:render.example:7777")
        picture = server.render("scene.txtpb")
    picture.xyz                                     # (height, width, 3) float32
    picture.save("scene.png")

The same for asyncio is metamer.aio. Names are those of the wire, the scene file and the command line.
"""
from metamer import aio
from metamer.blocking import Server, connect, local
from metamer.credentials import Credentials
from metamer.delta_e import delta_e_00, delta_e_ab, lab
from metamer.errors import (Disconnected, InputError, JobCancelled, JobFailed, MetamerError, NoServer, ProtocolError,
                            ServerError, ViewClosed)
from metamer.events import Event, Preview, Tile
from metamer.factors import Factors, read_factors
from metamer.picture import Picture, save_png
from metamer.scene import Scene
from metamer.session import Session
from metamer.spectra import SceneSpectra, Spectrum, xyz_of
from metamer.srgb import linear_srgb, to_srgb
from metamer.sweep import set_field, variants
from metamer.view import Frame, View

__all__ = ["Credentials", "Disconnected", "Event", "Factors", "Frame", "InputError", "JobCancelled", "JobFailed", "MetamerError",
           "NoServer", "Picture", "Preview", "ProtocolError", "Scene", "SceneSpectra", "Server", "ServerError", "Session",
           "Spectrum", "Tile", "View", "ViewClosed", "aio", "connect", "delta_e_00", "delta_e_ab", "lab", "linear_srgb", "local",
           "read_factors", "save_png", "set_field", "to_srgb", "variants", "xyz_of"]
