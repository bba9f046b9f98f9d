"""Packs the package that CMake has built; pyproject.toml has the rest."""

from setuptools import Distribution, setup


class BuiltDistribution(Distribution):
    """Has an extension module, though none to build, so that the wheel is named by its platform."""

    def has_ext_modules(self) -> bool:
        return True


setup(distclass=BuiltDistribution)
