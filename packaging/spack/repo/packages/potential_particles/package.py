# SPDX-License-Identifier: MIT OR Apache-2.0
from spack.package import *


class PotentialParticles(Package):
    """Contact detection between potential particles: convex shapes from sphere to polyhedron, with a bound on the error
    of every answer.

    From these sources: spack repo add packaging/spack/repo, then spack dev-build potential-particles@main.
    """

    license("MIT OR Apache-2.0", checked_by="the authors")

    # Built from the sources at hand; a release adds its url and sha256.
    version("main")

    depends_on("c", type="build")
    depends_on("rust@1.85:", type="build")

    def install(self, spec, prefix):
        install = Executable("scripts/install.sh")
        install(extra_env={"PREFIX": str(prefix), "PYTHON_DIR": ""})

    def test_header(self):
        """the header and the library belong together"""
        with working_dir(self.test_suite.stage, create=True):
            with open("try.c", "w") as source:
                source.write(
                    "#include <potential_particles.h>\n"
                    "int main(void) { return pp_abi_version() == PP_ABI_VERSION ? 0 : 1; }\n"
                )
            compiler = Executable(self.compiler.cc) if self.compiler else which("cc")
            compiler("try.c", "-o", "try", f"-I{self.prefix.include}", f"-L{self.prefix.lib}",
                     f"-Wl,-rpath,{self.prefix.lib}", "-lpotential_particles")
            Executable("./try")()
