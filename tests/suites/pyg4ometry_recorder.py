# SPDX-License-Identifier: Apache-2.0
"""Names of pyg4ometry that its tests of overlaps use, which write down what is built, as GDML.

Constants are numbers. Lengths are in mm, angles in radians, as there. What draws or compares does nothing.
"""
import sys
import types


class Constant(float):
    def __new__(cls, _name, value, _registry, _add=False):
        return float.__new__(cls, value)


class Registry:
    last = None

    def __init__(self):
        Registry.last = self
        self.solids, self.volumes, self.world = [], [], ''

    def setWorld(self, world):
        self.world = world if isinstance(world, str) else world.name

    def getWorldVolume(self):
        return self.world

    def gdml(self):
        structure = ''.join(volume.element() for volume in self.volumes)
        return (f'<gdml><define/><materials/><solids>{"".join(self.solids)}</solids><structure>{structure}</structure>'
                f'<setup name="Default" version="1.0"><world ref="{self.world}"/></setup></gdml>\n')


class Solid:
    def __init__(self, name, registry, element):
        self.name = name
        registry.solids.append(element)


def Box(name, x, y, z, registry, lunit='mm'):
    return Solid(name, registry, f'<box name="{name}" x="{float(x)!r}" y="{float(y)!r}" z="{float(z)!r}" lunit="{lunit}"/>')


def ExtrudedSolid(name, polygon, slices, registry):
    corners = ''.join(f'<twoDimVertex x="{x!r}" y="{y!r}"/>' for x, y in polygon)
    sections = ''.join(f'<section zOrder="{i}" zPosition="{z!r}" xOffset="{x!r}" yOffset="{y!r}" scalingFactor="{scale!r}"/>'
                       for i, (z, (x, y), scale) in enumerate(slices))
    return Solid(name, registry, f'<xtru name="{name}" lunit="mm">{corners}{sections}</xtru>')


class Volume:
    tag = 'volume'

    def __init__(self, name, registry, solid=None):
        self.name, self.solid, self.placed = name, solid, []
        registry.volumes.append(self)

    def checkOverlaps(self, **_options):
        pass

    def extent(self, **_options):
        pass

    def element(self):
        inner = f'<solidref ref="{self.solid.name}"/>' if self.solid else ''
        return f'<{self.tag} name="{self.name}">{inner}{"".join(self.placed)}</{self.tag}>'


class LogicalVolume(Volume):
    def __init__(self, solid, _material, name, registry):
        super().__init__(name, registry, solid)


class AssemblyVolume(Volume):
    tag = 'assembly'


class PhysicalVolume:
    def __init__(self, rotation, position, volume, name, mother, _registry, _add=True, scale=None):
        def triple(tag, values, unit=''):
            return f'<{tag} ' + ' '.join(f'{axis}="{float(v)!r}"' for axis, v in zip('xyz', values)) + f'{unit}/>'

        mother.placed.append(f'<physvol name="{name}"><volumeref ref="{volume.name}"/>' + triple('position', position, ' unit="mm"')
                             + triple('rotation', rotation, ' unit="rad"') + (triple('scale', scale) if scale else '')
                             + '</physvol>')


class ReplicaVolume:
    class Axis:
        kXAxis, kYAxis, kZAxis = 'x', 'y', 'z'

    def __init__(self, _name, volume, mother, axis, number, width, offset, _registry, _add=True, wunit='mm', ounit='mm'):
        mother.placed.append(
            f'<replicavol number="{number}"><volumeref ref="{volume.name}"/><replicate_along_axis><direction {axis}="1"/>'
            f'<width value="{width!r}" unit="{wunit}"/><offset value="{offset!r}" unit="{ounit}"/></replicate_along_axis></replicavol>')


class Nothing:
    def __init__(self, *_arguments, **_options):
        pass

    def addDetector(self, _registry):
        pass

    def write(self, _path):
        pass


def install():
    """Makes these the modules that `import pyg4ometry` finds."""
    names = {
        'gdml': {'Constant': Constant, 'Position': Nothing, 'Writer': Nothing},
        'geant4': {'Registry': Registry, 'MaterialPredefined': Nothing, 'LogicalVolume': LogicalVolume,
                   'AssemblyVolume': AssemblyVolume, 'PhysicalVolume': PhysicalVolume, 'ReplicaVolume': ReplicaVolume,
                   'solid': types.SimpleNamespace(Box=Box, ExtrudedSolid=ExtrudedSolid)},
        'visualisation': {},
        'misc': {'compareGdmlNumericallyWithAssert': lambda *_: None},
    }
    package = sys.modules['pyg4ometry'] = types.ModuleType('pyg4ometry')
    package.__path__ = []
    for name, members in names.items():
        module = sys.modules[f'pyg4ometry.{name}'] = types.ModuleType(f'pyg4ometry.{name}')
        module.__dict__.update(members)
        setattr(package, name, module)
