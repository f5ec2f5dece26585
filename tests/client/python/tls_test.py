"""By TLS: whom a client trusts, and who it says it is."""
import os
import pathlib
import subprocess
import tempfile
import unittest
from unittest import mock

import metamer
from metamer import errors
from support import BIN, scene

QUIET = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "check": True}


def make_certificate(folder: pathlib.Path, name: str) -> tuple[str, str]:
    """One that has signed itself, and its key."""
    certificate, key = f"{folder}/{name}.pem", f"{folder}/{name}.key"
    subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-days", "2",
                    "-subj", f"/CN={name}", "-addext", "subjectAltName=IP:127.0.0.1", "-keyout", key, "-out", certificate],
                   **QUIET)
    return certificate, key


class Tls(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.certificate, key = make_certificate(cls.folder, "server")
        cls.other, _ = make_certificate(cls.folder, "other")
        state = str(cls.folder / "state")
        cls.process = subprocess.Popen(
            [BIN / "metamerd", "--listen", "tls:127.0.0.1:0", "--state", state, "--tls-cert", cls.certificate, "--tls-key", key,
             "--log-level", "info", "--unconfined"], stderr=subprocess.PIPE, text=True)
        cls.addClassCleanup(cls.end)
        for line in cls.process.stderr:
            if "listening on tls:" in line:
                cls.address = "tls:" + line.split("listening on tls:")[1].split()[0]
                break
        added = subprocess.run([BIN / "metamerd", "user", "add", "ann", "--role", "submitter", "--token", "desk", "--state",
                                state], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=True)
        cls.token = added.stdout.strip()

    @classmethod
    def end(cls) -> None:
        cls.process.terminate()
        cls.process.communicate()

    def fingerprint(self, certificate: str) -> str:
        said = subprocess.run(["openssl", "x509", "-in", certificate, "-noout", "-fingerprint", "-sha256"],
                              stdout=subprocess.PIPE, text=True, check=True)
        return said.stdout.split("=")[1].strip().replace(":", "").lower()

    def test_who_is_not_trusted_is_told_nothing(self) -> None:
        for doubt in (metamer.Credentials(token=self.token), metamer.Credentials(token=self.token, authorities=self.other),
                      metamer.Credentials(token=self.token, fingerprint=self.fingerprint(self.other))):
            with self.assertRaises(metamer.NoServer):
                metamer.connect(self.address, doubt)

    def test_a_user_renders_by_a_token(self) -> None:
        for known in (metamer.Credentials(token=self.token, fingerprint=self.fingerprint(self.certificate)),
                      metamer.Credentials(token=self.token, authorities=self.certificate)):
            with metamer.connect(self.address, known) as server:
                self.assertEqual(server.welcome.user, "ann")
                job = server.render(scene()).job_id
                handle = server.handle(job)
                self.assertEqual(handle, f"{job}@{server.welcome.server_id.hex()[:8]}")  # it has a state
                self.assertEqual(server.picture(handle).xyz.shape, (16, 32, 3))

    def test_what_login_has_kept_is_enough(self) -> None:
        (self.folder / "token").write_text(self.token)
        (self.folder / "token").chmod(0o600)
        with mock.patch.dict(os.environ, {"XDG_CONFIG_HOME": str(self.folder / "config")}):
            subprocess.run([BIN / "metamer", "login", self.address, "--token-file", self.folder / "token", "--fingerprint",
                            self.fingerprint(self.certificate)], **QUIET)
            with metamer.connect(self.address) as server:
                self.assertEqual(server.welcome.user, "ann")

    def test_a_token_that_is_none(self) -> None:
        with self.assertRaises(errors.Unauthenticated):
            metamer.connect(self.address, metamer.Credentials(token="mtr_no", authorities=self.certificate))

    def test_a_plain_client_is_no_guest(self) -> None:
        with self.assertRaisesRegex(metamer.ProtocolError, "tls:"):
            metamer.connect(self.address.removeprefix("tls:"), metamer.Credentials())


if __name__ == "__main__":
    unittest.main()
