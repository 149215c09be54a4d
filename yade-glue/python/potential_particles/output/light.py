# SPDX-License-Identifier: GPL-3.0-or-later
"""What VTK's shaders add to a surface: the shadow of the sun, the light of the sky, and boundaries that fade into the
paper.

Coordinates are those of the picture: the middle of the scene at 0, its radius 1.
"""
import numpy as np
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkTexture, vtkWindowToImageFilter

from .view import View, unit

SUN = unit([-0.45, -0.55, 1.0])  # from the scene to the sun
# The sky is brightest here, and half as bright from the other side, so that faces differ in the shadow too.
SKY = unit([0.45, -0.3, 0.85])
SUN_PIXELS = 1500  # of its map, along each side
SUN_REACH = 1.02  # half the width of its map
SUN_NEAR, SUN_FAR = 1.9, 4.1  # of its map, from where it stands
SUN_STANDS = 3.0
ABOVE = 1.5 * 2.0 * SUN_REACH / SUN_PIXELS  # along the normal, so that no surface shadows itself: 1.5 pixels of the map
# Boundaries fade into the paper between these distances from the middle.
FADE = (1.1, 2.2)

# In the coordinates of the camera, as VTK's shaders are. A point is as far in shadow as the pixels of the map around
# it.
_SHADOW = """
  vec3 onMap = mat3({turn}) * (vertexVCVSOutput.xyz + {above} * normalVCVSOutput) + vec3({shift});
  float seen = 0.0;
  for (int i = -1; i < 2; ++i)
    for (int j = -1; j < 2; ++j)
    {{
      vec2 at = onMap.xy + vec2(i, j) * {pixel};
      bool inside = all(greaterThan(at, vec2(0.0))) && all(lessThan(at, vec2(1.0)));
      float nearest = texture(sunMap, clamp(at, 0.0, 1.0)).r;
      seen += inside && nearest < 1.0 && onMap.z > nearest ? 0.0 : 1.0;
    }}
  diffuseColor *= seen / 9.0;
"""
_SKY = """
  ambientColor *= 0.75 + 0.25 * dot(normalVCVSOutput, vec3({sky}));
"""
_FADING = """
  float far = clamp(({outer} - distance(vertexVCVSOutput.xyz, vec3({middle}))) / {width}, 0.0, 1.0);
  if (far == 0.0) discard;
  far = far * far * (3.0 - 2.0 * far);
  gl_FragData[0] = gl_FragData[0].a < 1.0 ? vec4(gl_FragData[0].rgb, far * gl_FragData[0].a)
                                          : vec4(mix(vec3(1.0), gl_FragData[0].rgb, far), 1.0);
"""


def sun_map(window, actor):
    """How near to the sun the nearest surface of an actor is, 0 to 1, as a texture."""
    renderer = vtkRenderer()
    renderer.AddActor(actor)
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetParallelScale(SUN_REACH)
    camera.SetPosition(SUN_STANDS * SUN)
    camera.SetViewUp(_sun_axes()[1])
    camera.SetFocalPoint(0.0, 0.0, 0.0)
    camera.SetClippingRange(SUN_NEAR, SUN_FAR)
    window.SetSize(SUN_PIXELS, SUN_PIXELS)
    window.AddRenderer(renderer)
    window.Render()
    depth = vtk_to_numpy(read(window, depth=True).GetPointData().GetScalars())
    window.RemoveRenderer(renderer)
    # Three times: VTK rounds a texture of fewer components to eight bits.
    image = vtkImageData()
    image.SetDimensions(SUN_PIXELS, SUN_PIXELS, 1)
    image.GetPointData().SetScalars(numpy_to_vtk(np.repeat(depth[:, None], 3, axis=1), deep=True))
    texture = vtkTexture()
    texture.SetInputData(image)
    texture.SetColorModeToDirectScalars()
    texture.InterpolateOff()
    return texture


def read(window, depth=False):
    """The picture in a window, as VTK's image; or the depth of its pixels."""
    reader = vtkWindowToImageFilter()
    reader.SetInput(window)
    reader.ReadFrontBufferOff()
    reader.ShouldRerenderOff()
    if depth:
        reader.SetInputBufferTypeToZBuffer()
    reader.Update()
    return reader.GetOutput()


def light(actor, shadows, view, fading):
    """Lets what is in shadows (sun_map; or None) shadow an actor in a picture of this view, and the actor vanish far
    away if it fades.
    """
    right, up, forward = view.axes()
    to_camera = np.stack([right, up, -forward])
    code = _SKY.format(sky=_numbers(to_camera @ SKY)) + "//VTK::Light::Impl\n"
    if shadows is not None:
        actor.GetProperty().SetTexture("sunMap", shadows)  # the name by which VTK declares it
        # From the world to the map: 0 to 1 in all three.
        to_map = _sun_axes() / np.array([2.0 * SUN_REACH, 2.0 * SUN_REACH, SUN_NEAR - SUN_FAR])[:, None]
        shift = to_map @ view.eye + [0.5, 0.5, (SUN_STANDS - SUN_NEAR) / (SUN_FAR - SUN_NEAR)]
        # GLSL takes matrices by columns.
        turn = _numbers((to_map @ to_camera.T).T)
        code = _SHADOW.format(turn=turn, shift=_numbers(shift), above=ABOVE, pixel=1.0 / SUN_PIXELS) + code
    if fading:
        code += _FADING.format(outer=FADE[1], width=FADE[1] - FADE[0], middle=_numbers(-to_camera @ view.eye))
    actor.GetShaderProperty().AddFragmentShaderReplacement("//VTK::Light::Impl", True, code, False)


def _sun_axes():
    """Right, up, towards the sun: rows."""
    right, up, forward = View(SUN, np.zeros(3), 0.0).axes()
    return np.stack([right, up, -forward])


def _numbers(values):
    return ", ".join(f"{value:.9e}" for value in np.ravel(values))
