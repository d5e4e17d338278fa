# Written by stubs.py from the options of the programs; do not edit.
import os
from collections.abc import Sequence
from typing import Any, Literal, TypedDict, Union

import numpy as np

Vector = Union[Sequence[float], np.ndarray[Any, Any]]
Values = Union[Vector, Sequence[Vector]]
Text = Union[str, os.PathLike[str]]

class Reading(TypedDict, total=False):
    threads: int | None
    """N. Use N threads [default: all]. The result does not depend on it"""
    nt: int | None
    """The same as threads."""
    lax: bool | None
    """True. Warn about unknown statements and pass them on"""
    allow_execute: bool | None
    """True. Run the programs that `execute` statements name"""
    allow_outside: bool | None
    """True. Read files that the input names outside its folder"""
    limit: str | Sequence[str] | None
    """NAME=N. Change a limit on the size of scenes"""

class Lorentz(TypedDict, total=False):
    threads: int | None
    """N. Use N threads [default: all]. The result does not depend on it"""
    nt: int | None
    """The same as threads."""
    velocity: Vector | None
    """X Y Z. Velocity of all objects, fraction of c [default: the scene's, else 0]"""
    vel: Vector | None
    """The same as velocity."""
    camera_velocity: Vector | None
    """X Y Z. Velocity of the camera in the scene, fraction of c [default: the scene's, else 0]"""
    cv: Vector | None
    """The same as camera_velocity."""
    time: float | str | None
    """T. Time of the picture on the observer's clock [default: 0]"""
    ti: float | str | None
    """The same as time."""
    anchor: float | str | None
    """POINT. Fixed point of the contraction: eye, origin, center or X Y Z"""
    an: float | str | None
    """The same as anchor."""
    keep_in_view: bool | None
    """True. Keep bodies in view: they appear where the scene has them"""
    in_place: bool | None
    """The same as keep_in_view."""
    in_: bool | None
    """The same as keep_in_view."""
    ahead: bool | None
    """True. View ahead of a moving camera: the picture shows at every speed what it shows at rest"""
    error: float | str | None
    """ERR. Largest error of edges: milliradians at the eye, or pixels, .15px [default: 0.1]"""
    se: float | str | None
    """The same as error."""
    color_error: float | str | None
    """PERCENT. Subdivide also until the interpolated Doppler factor deviates by at most PERCENT, or off [default: 0.15]"""
    sc: float | str | None
    """The same as color_error."""
    light_error: float | str | None
    """PERCENT. Subdivide also until the interpolated light of near lamps deviates by at most PERCENT [default: off]"""
    sl: float | str | None
    """The same as light_error."""
    pieces: float | str | None
    """N. Cut every edge into N equal pieces, instead of error=, color_error= and light_error="""
    sd: float | str | None
    """The same as pieces."""
    smooth: bool | None
    """True. Write vertex normals for smooth shading"""
    sm: bool | None
    """The same as smooth."""
    repeat_vertices: bool | None
    """True. Keep colours of faces apart where they share vertices"""
    vr: bool | None
    """The same as repeat_vertices."""
    no_contraction: bool | None
    """True. For teaching: omit Lorentz contraction"""
    nc: bool | None
    """The same as no_contraction."""
    no_flight_time: bool | None
    """True. For teaching: omit the light travel time"""
    measured: Text | None
    """FRAME. Where bodies are at one time of a frame, not where they are seen: camera, scene, or a body"""
    look: Text | None
    """LOOK. Look of the picture, in one word: 1988, light, shape [default: light in photon(), warp() and film(), 1988 in the others]"""
    cull: bool | None
    """True. Remove faces that are outside the view of the camera"""
    camera: Text | None
    """NAME. The camera of this name [default: the first without a name, else the first]"""
    cam: Text | None
    """The same as camera."""
    eye: Vector | None
    """X Y Z. Eye point [default: that of the scene's camera]"""
    ep: Vector | None
    """The same as eye."""
    center: Vector | None
    """X Y Z. View centre, shown in the middle of the picture [default: that of the scene's camera, else the scene's middle]"""
    vc: Vector | None
    """The same as center."""
    up: Vector | None
    """X Y Z. Up direction [default: that of the scene's camera, else 0 0 1]"""
    ud: Vector | None
    """The same as up."""
    view_angle: Vector | float | str | None
    """A B. Full horizontal and, if given, vertical view angle, in degrees [default: that of the scene's camera, else 40]"""
    va: Vector | float | str | None
    """The same as view_angle."""
    orthographic: bool | None
    """True. Orthographic projection"""
    og: bool | None
    """The same as orthographic."""
    size: Vector | None
    """W H. Size of the picture in pixels, of which mostly the aspect ratio is used [default: 1024 768]"""
    sz: Vector | None
    """The same as size."""

class Doppler(TypedDict, total=False):
    threads: int | None
    """N. Use N threads [default: all]. The result does not depend on it"""
    nt: int | None
    """The same as threads."""
    velocity: Vector | None
    """X Y Z. Velocity of faces that carry none, fractions of c"""
    vel: Vector | None
    """The same as velocity."""
    wavelengths: bool | None
    """True. Write wavelengths (nm) instead of hues"""
    gw: bool | None
    """The same as wavelengths."""
    brightness: Text | None
    """LAW. Brightness law: report (D), photon (D^3), bolometric (D^4), none [default: report]"""
    br: Text | None
    """The same as brightness."""
    spectral: bool | None
    """True. Shift spectra instead of hues"""
    sp: bool | None
    """The same as spectral."""
    no_doppler: bool | None
    """True. Leave wavelengths as they are"""
    infrared_rule: float | str | None
    """RULE. Infrared of surfaces of which only the colour is known: measured, constant [default: measured]"""
    no_flux: bool | None
    """True. Leave brightness as it is; with spectral=True omit the factor D^5"""
    repeat_vertices: bool | None
    """True. Keep colours of faces apart where they share vertices"""
    vr: bool | None
    """The same as repeat_vertices."""
    color_tolerance: float | str | None
    """T. Reuse a colour that differs by at most T nm and T percent of value, or with spectral=True by T percent of X, Y and Z; 0: a colour for each vertex [default: 0.1]"""
    ct: float | str | None
    """The same as color_tolerance."""
    iris: bool | None
    """True. Iris: scale all values so that the brightest is 1"""
    ir: bool | None
    """The same as iris."""
    light: bool | None
    """True. Light the scene by its lights, moving ones included"""
    li: bool | None
    """The same as light."""
    keep_intensities: bool | None
    """True. Keep values above 1 for the exposure of the renderer"""
    hd: bool | None
    """The same as keep_intensities."""
    no_textures: bool | None
    """True. Give faces with textures their mean colour"""
    look: Text | None
    """LOOK. Look of the picture, in one word: 1988, light, shape [default: light in photon(), warp() and film(), 1988 in the others]"""
    camera: Text | None
    """NAME. The camera of this name [default: the first without a name, else the first]"""
    cam: Text | None
    """The same as camera."""
    eye: Vector | None
    """X Y Z. Eye point [default: that of the scene's camera]"""
    ep: Vector | None
    """The same as eye."""
    sky: Text | None
    """SKY. Sky behind the scene: day, dusk, stars, or a file"""
    sky_turn: Vector | None
    """X Y Z. Turn the sky by these angles about x, then y, then z, in degrees"""

class Render(TypedDict, total=False):
    threads: int | None
    """N. Use N threads [default: all]. The result does not depend on it"""
    nt: int | None
    """The same as threads."""
    interpolate_hue: bool | None
    """True. Interpolate hue between corners (default)"""
    ih: bool | None
    """The same as interpolate_hue."""
    interpolate_wavelength: bool | None
    """True. Interpolate wavelength between corners"""
    iw: bool | None
    """The same as interpolate_wavelength."""
    wavelengths: bool | None
    """True. Hues in colour statements are wavelengths in nm; implies interpolate_wavelength=True"""
    wi: bool | None
    """The same as wavelengths."""
    format: Text | None
    """FMT. Format of the picture [default: by the ending of output, else png]"""
    dt: Text | None
    """The same as format."""
    dp: bool | None
    """True. Write PostScript to the file POSTSCRIPTFILE, or to that of output, as in 1988"""
    vector: bool | None
    """True. Vector graphics instead of pixels, for eps, ps, pdf, svg"""
    vec: bool | None
    """The same as vector."""
    text: bool | None
    """True. Text of captions, legends and grids as text in vector graphics, instead of outlines"""
    txt: bool | None
    """The same as text."""
    repeat_vertices: bool | None
    """True. Keep colours of faces apart where they share vertices"""
    vr: bool | None
    """The same as repeat_vertices."""
    camera: Text | None
    """NAME. The camera of this name [default: the first without a name, else the first]"""
    cam: Text | None
    """The same as camera."""
    eye: Vector | None
    """X Y Z. Eye point [default: that of the scene's camera]"""
    ep: Vector | None
    """The same as eye."""
    center: Vector | None
    """X Y Z. View centre, shown in the middle of the picture [default: that of the scene's camera, else the scene's middle]"""
    vc: Vector | None
    """The same as center."""
    up: Vector | None
    """X Y Z. Up direction [default: that of the scene's camera, else 0 0 1]"""
    ud: Vector | None
    """The same as up."""
    view_angle: Vector | float | str | None
    """A B. Full horizontal and, if given, vertical view angle, in degrees [default: that of the scene's camera, else 40]"""
    va: Vector | float | str | None
    """The same as view_angle."""
    orthographic: bool | None
    """True. Orthographic projection"""
    og: bool | None
    """The same as orthographic."""
    size: Vector | None
    """W H. Size of the picture in pixels, or in mm, cm, in, pt [default: 1024 768]"""
    sz: Vector | None
    """The same as size."""
    samples: float | str | None
    """N. N x N samples per pixel, 1 to 16 [default: 4]"""
    aa: float | str | None
    """The same as samples."""
    filter: Text | None
    """FILTER. Reconstruction filter from samples to pixels: box, triangle, spline [default: box]"""
    fl: Text | None
    """The same as filter."""
    background: Vector | float | str | None
    """L H S. Background colour: lightness, hue in degrees, saturation; a name, or #rrggbb [default: black]"""
    bg: Vector | float | str | None
    """The same as background."""
    transparent: bool | None
    """True. Transparent background"""
    tb: bool | None
    """The same as transparent."""
    exposure: float | str | None
    """E|auto. Exposure in stops, or auto"""
    ex: float | str | None
    """The same as exposure."""
    tone_curve: Text | None
    """CURVE. Tone curve from light to display: clip, filmic [default: clip]"""
    tc: Text | None
    """The same as tone_curve."""
    pack: bool | None
    """True. Smaller PNG files, which take longer to compress"""
    pz: bool | None
    """The same as pack."""
    channels: str | Sequence[str] | None
    """LIST. Channels to add to an EXR picture, separated by commas: D, time, distance, Z, id, velocity, direction, position, ray"""
    ch: str | Sequence[str] | None
    """The same as channels."""
    cull_back_faces: bool | None
    """True. Cull back faces, whose corners run clockwise in the picture"""
    cb: bool | None
    """The same as cull_back_faces."""
    depth_cue: Vector | float | str | bool | None
    """NEAR FAR LEAST. Depth cueing: between the depths NEAR and FAR, light fades linearly into the background, to the fraction LEAST"""
    dc: Vector | float | str | bool | None
    """The same as depth_cue."""
    wireframe: bool | None
    """True. Wireframe: draw edges of faces as lines, instead of faces; faces still occlude them"""
    wf: bool | None
    """The same as wireframe."""
    edges: bool | None
    """True. Draw edges of faces as black lines, over the faces"""
    ed: bool | None
    """The same as edges."""
    silhouette: bool | None
    """True. Silhouette: of edges only those where a body turns away from the eye, and those of a single face"""
    sil: bool | None
    """The same as silhouette."""
    crease: float | str | None
    """ANGLE. Of edges only the silhouette and creases of at least ANGLE degrees, 0 to 180"""
    hidden_lines: float | str | None
    """STYLE. Lines that are hidden by faces: dash, thin [default: not drawn]"""
    hl: float | str | None
    """The same as hidden_lines."""
    line_color: Vector | float | str | None
    """L H S. Colour of the edges, as for background= [default: colours of the faces with wireframe=True, black with edges=True]"""
    lc: Vector | float | str | None
    """The same as line_color."""
    line_width: float | None
    """W. Width of edges and wires in pixels [default: 1.2]"""
    lw: float | None
    """The same as line_width."""
    exact: bool | None
    """True. Exact: a ray for every sample, instead of subdivision"""
    xc: bool | None
    """The same as exact."""
    brightness: Text | None
    """LAW. Brightness law: report (D), photon (D^3), bolometric (D^4), none [default: report]"""
    br: Text | None
    """The same as brightness."""
    spectral: bool | None
    """True. Shift spectra instead of hues"""
    sp: bool | None
    """The same as spectral."""
    no_doppler: bool | None
    """True. Leave wavelengths as they are"""
    infrared_rule: float | str | None
    """RULE. Infrared of surfaces of which only the colour is known: measured, constant [default: measured]"""
    no_flux: bool | None
    """True. Leave brightness as it is; with spectral=True omit the factor D^5"""
    look: Text | None
    """LOOK. Look of the picture, in one word: 1988, light, shape [default: light in photon(), warp() and film(), 1988 in the others]"""
    sky: Text | None
    """SKY. Sky behind the scene: day, dusk, stars, or a file"""
    sky_turn: Vector | None
    """X Y Z. Turn the sky by these angles about x, then y, then z, in degrees"""
    title: Text | None
    """TEXT. Title above the picture, wrapped as needed"""
    caption: Text | None
    """TEXT. Caption below the picture, wrapped as needed; line breaks are kept"""
    cap: Text | None
    """The same as caption."""
    legend: bool | None
    """True. Legend below the picture: spectrum, velocities, Doppler factors"""
    lg: bool | None
    """The same as legend."""
    legend_place: float | str | None
    """PLACE. Place of caption, legend and scale: below, beside, or over a corner, as top-left"""
    lp: float | str | None
    """The same as legend_place."""
    undistorted: bool | None
    """True. Outline of moving bodies as they would look at rest, centred where each body is seen"""
    dl: bool | None
    """The same as undistorted."""
    grid: bool | None
    """True. Grid of coordinates on the ground: in the plane z = 0, or at the lowest point of the scene if that is lower"""
    gr: bool | None
    """The same as grid."""
    map: str | Sequence[str | float] | None
    """QUANTITY LOW HIGH. Instead of light a quantity in false colours, with its scale: D, time, distance, speed, z"""
    iso: str | Sequence[str | float] | None
    """QUANTITY VALUE. Lines of equal values of a quantity over the picture: D, time, distance, speed, z"""
    text_size: float | str | None
    """PIXELS. Size of text in pixels, 4 to 200 [default: 1/40 of the geometric mean of size=]"""
    ts: float | str | None
    """The same as text_size."""
    unit: float | str | None
    """UNIT. What a length of 1 in the scene is: m, km, ls (a light-second) ...; with a number, as '20 m'"""
    speed_of_light: float | str | None
    """SPEED. The speed of light in legends and captions, as 30km/h [default: as in vacuum]"""
    c: float | str | None
    """The same as speed_of_light."""

class Photon(TypedDict, total=False):
    threads: int | None
    """N. Use N threads [default: all]. The result does not depend on it"""
    nt: int | None
    """The same as threads."""
    velocity: Vector | None
    """X Y Z. Velocity of all objects, fraction of c [default: the scene's, else 0]"""
    vel: Vector | None
    """The same as velocity."""
    camera_velocity: Vector | None
    """X Y Z. Velocity of the camera in the scene, fraction of c [default: the scene's, else 0]"""
    cv: Vector | None
    """The same as camera_velocity."""
    time: float | str | None
    """T. Time of the picture on the observer's clock [default: 0]"""
    ti: float | str | None
    """The same as time."""
    anchor: float | str | None
    """POINT. Fixed point of the contraction: eye, origin, center or X Y Z"""
    an: float | str | None
    """The same as anchor."""
    keep_in_view: bool | None
    """True. Keep bodies in view: they appear where the scene has them"""
    in_place: bool | None
    """The same as keep_in_view."""
    in_: bool | None
    """The same as keep_in_view."""
    ahead: bool | None
    """True. View ahead of a moving camera: the picture shows at every speed what it shows at rest"""
    brightness: Text | None
    """LAW. Brightness law: report (D), photon (D^3), bolometric (D^4), none [default: report]"""
    br: Text | None
    """The same as brightness."""
    spectral: bool | None
    """True. Shift spectra instead of hues"""
    sp: bool | None
    """The same as spectral."""
    no_doppler: bool | None
    """True. Leave wavelengths as they are"""
    infrared_rule: float | str | None
    """RULE. Infrared of surfaces of which only the colour is known: measured, constant [default: measured]"""
    no_flux: bool | None
    """True. Leave brightness as it is; with spectral=True omit the factor D^5"""
    interpolate_wavelength: bool | None
    """True. Interpolate wavelengths between corners, instead of hues"""
    iw: bool | None
    """The same as interpolate_wavelength."""
    wavelengths: bool | None
    """True. Hues in colour statements are wavelengths in nm; implies interpolate_wavelength=True"""
    wi: bool | None
    """The same as wavelengths."""
    repeat_vertices: bool | None
    """True. Keep colours of faces apart where they share vertices"""
    vr: bool | None
    """The same as repeat_vertices."""
    depth: float | str | None
    """N. Most reflections and refractions along a path [default: 16]"""
    rd: float | str | None
    """The same as depth."""
    cut_off: float | str | None
    """PART. Least part of a pixel's light that is followed [default: 0.01]"""
    rc: float | str | None
    """The same as cut_off."""
    no_shadows: bool | None
    """True. Without shadows: light reaches surfaces through all others"""
    no_sky_light: bool | None
    """True. The sky does not light the scene"""
    fresnel: bool | None
    """True. Fresnel's equations for mirrors and glass"""
    film_shutter: float | str | None
    """DISTANCE. Shutter at the film, at this distance behind the pinhole"""
    panorama: bool | None
    """True. Panorama of all directions"""
    pan: bool | None
    """The same as panorama."""
    fisheye: float | str | None
    """ANGLE. Fisheye: ANGLE degrees in a circle, as for domes"""
    fish: float | str | None
    """The same as fisheye."""
    cube_map: bool | None
    """True. Cube map: six square views from left to right"""
    cube: bool | None
    """The same as cube_map."""
    stereo: float | str | None
    """DISTANCE. A picture for each of two eyes at this distance"""
    smooth: bool | None
    """True. Smooth shading"""
    sm: bool | None
    """The same as smooth."""
    stage: bool | None
    """True. Stand the scene on a grey ground, under a sky: day, unless sky= gives another"""
    look: Text | None
    """LOOK. Look of the picture, in one word: 1988, light, shape [default: light in photon(), warp() and film(), 1988 in the others]"""
    adaptive: float | str | None
    """CONTRAST. Adaptive samples: fewer in pixels of less contrast than this"""
    ad: float | str | None
    """The same as adaptive."""
    crop: Vector | None
    """X Y W H. Draw only a part of the picture: column, row, width, height"""
    radiances: bool | None
    """True. Add channels of radiances at wavelengths to an EXR picture"""
    format: Text | None
    """FMT. Format of the picture [default: by the ending of output, else png]"""
    dt: Text | None
    """The same as format."""
    size: Vector | None
    """W H. Size of the picture in pixels, or in mm, cm, in, pt [default: 1024 768]"""
    sz: Vector | None
    """The same as size."""
    samples: float | str | None
    """N. N x N samples per pixel, 1 to 16 [default: 4]"""
    aa: float | str | None
    """The same as samples."""
    filter: Text | None
    """FILTER. Reconstruction filter from samples to pixels: box, triangle, spline [default: box]"""
    fl: Text | None
    """The same as filter."""
    background: Vector | float | str | None
    """L H S. Background colour: lightness, hue in degrees, saturation; a name, or #rrggbb [default: black]"""
    bg: Vector | float | str | None
    """The same as background."""
    transparent: bool | None
    """True. Transparent background"""
    tb: bool | None
    """The same as transparent."""
    exposure: float | str | None
    """E|auto. Exposure in stops, or auto"""
    ex: float | str | None
    """The same as exposure."""
    tone_curve: Text | None
    """CURVE. Tone curve from light to display: clip, filmic [default: clip]"""
    tc: Text | None
    """The same as tone_curve."""
    pack: bool | None
    """True. Smaller PNG files, which take longer to compress"""
    pz: bool | None
    """The same as pack."""
    channels: str | Sequence[str] | None
    """LIST. Channels to add to an EXR picture, separated by commas: D, time, distance, Z, id, velocity, direction, position, ray"""
    ch: str | Sequence[str] | None
    """The same as channels."""
    sky: Text | None
    """SKY. Sky behind the scene: day, dusk, stars, or a file"""
    sky_turn: Vector | None
    """X Y Z. Turn the sky by these angles about x, then y, then z, in degrees"""
    camera: Text | None
    """NAME. The camera of this name [default: the first without a name, else the first]"""
    cam: Text | None
    """The same as camera."""
    eye: Vector | None
    """X Y Z. Eye point [default: that of the scene's camera]"""
    ep: Vector | None
    """The same as eye."""
    center: Vector | None
    """X Y Z. View centre, shown in the middle of the picture [default: that of the scene's camera, else the scene's middle]"""
    vc: Vector | None
    """The same as center."""
    up: Vector | None
    """X Y Z. Up direction [default: that of the scene's camera, else 0 0 1]"""
    ud: Vector | None
    """The same as up."""
    view_angle: Vector | float | str | None
    """A B. Full horizontal and, if given, vertical view angle, in degrees [default: that of the scene's camera, else 40]"""
    va: Vector | float | str | None
    """The same as view_angle."""
    orthographic: bool | None
    """True. Orthographic projection"""
    og: bool | None
    """The same as orthographic."""
    title: Text | None
    """TEXT. Title above the picture, wrapped as needed"""
    caption: Text | None
    """TEXT. Caption below the picture, wrapped as needed; line breaks are kept"""
    cap: Text | None
    """The same as caption."""
    legend: bool | None
    """True. Legend below the picture: spectrum, velocities, Doppler factors"""
    lg: bool | None
    """The same as legend."""
    legend_place: float | str | None
    """PLACE. Place of caption, legend and scale: below, beside, or over a corner, as top-left"""
    lp: float | str | None
    """The same as legend_place."""
    undistorted: bool | None
    """True. Outline of moving bodies as they would look at rest, centred where each body is seen"""
    dl: bool | None
    """The same as undistorted."""
    grid: bool | None
    """True. Grid of coordinates on the ground: in the plane z = 0, or at the lowest point of the scene if that is lower"""
    gr: bool | None
    """The same as grid."""
    map: str | Sequence[str | float] | None
    """QUANTITY LOW HIGH. Instead of light a quantity in false colours, with its scale: D, time, distance, speed, z"""
    iso: str | Sequence[str | float] | None
    """QUANTITY VALUE. Lines of equal values of a quantity over the picture: D, time, distance, speed, z"""
    text_size: float | str | None
    """PIXELS. Size of text in pixels, 4 to 200 [default: 1/40 of the geometric mean of size=]"""
    ts: float | str | None
    """The same as text_size."""
    unit: float | str | None
    """UNIT. What a length of 1 in the scene is: m, km, ls (a light-second) ...; with a number, as '20 m'"""
    speed_of_light: float | str | None
    """SPEED. The speed of light in legends and captions, as 30km/h [default: as in vacuum]"""
    c: float | str | None
    """The same as speed_of_light."""

class Warp(Reading, total=False):
    velocity: Vector | None
    """X Y Z. Velocity of the surroundings, fraction of c"""
    vel: Vector | None
    """The same as velocity."""
    camera_velocity: Vector | None
    """X Y Z. Velocity of the camera in the panorama, fraction of c"""
    cv: Vector | None
    """The same as camera_velocity."""
    from_: Text | None
    """KIND. Arrangement of directions: panorama, strip, cross, sides [default: panorama]"""
    part: Vector | None
    """WEST EAST SOUTH NORTH. Angles that the panorama shows, in degrees [default: -180 180 -90 90]"""
    scene: Text | None
    """FILE. Scene whose camera takes the picture"""
    time: float | str | None
    """T. Time of the picture on the clock of the camera of scene= [default: 0]"""
    ti: float | str | None
    """The same as time."""
    camera: Text | None
    """NAME. The camera of this name [default: the first without a name, else the first]"""
    cam: Text | None
    """The same as camera."""
    eye: Vector | None
    """X Y Z. Eye point [default: that of the scene's camera]"""
    ep: Vector | None
    """The same as eye."""
    center: Vector | None
    """X Y Z. View centre, shown in the middle of the picture [default: that of the scene's camera, else the scene's middle]"""
    vc: Vector | None
    """The same as center."""
    up: Vector | None
    """X Y Z. Up direction [default: that of the scene's camera, else 0 0 1]"""
    ud: Vector | None
    """The same as up."""
    view_angle: Vector | float | str | None
    """A B. Full horizontal and, if given, vertical view angle, in degrees [default: that of the scene's camera, else 40]"""
    va: Vector | float | str | None
    """The same as view_angle."""
    orthographic: bool | None
    """True. Orthographic projection"""
    og: bool | None
    """The same as orthographic."""
    brightness: Text | None
    """LAW. Brightness law: report (D), photon (D^3), bolometric (D^4), none [default: report]"""
    br: Text | None
    """The same as brightness."""
    spectral: bool | None
    """True. Shift spectra instead of hues"""
    sp: bool | None
    """The same as spectral."""
    no_doppler: bool | None
    """True. Leave wavelengths as they are"""
    infrared_rule: float | str | None
    """RULE. Infrared of surfaces of which only the colour is known: measured, constant [default: measured]"""
    no_flux: bool | None
    """True. Leave brightness as it is; with spectral=True omit the factor D^5"""
    basis: Vector | float | str | None
    """BASIS T2 T3. Spectra of colours: mixture, or three temperatures [default: mixture]"""
    highlights: float | str | None
    """STOPS. How much brighter than white clipped highlights of a photograph are, in stops"""
    infrared: Text | None
    """FILE. Panorama of infrared light"""
    infrared_to: float | str | None
    """NM. Longest wavelength of the infrared panorama, nm [default: 1400]"""
    ultraviolet: Text | None
    """FILE. Panorama of ultraviolet light"""
    ultraviolet_from: float | str | None
    """NM. Shortest wavelength of the ultraviolet panorama, nm [default: 200]"""
    stars: float | str | None
    """LIST. Draw the stars of a list in front of the panorama"""
    star_width: float | str | None
    """PIXELS. Width of stars at half of their maximum, in pixels [default: 1.7]"""
    white: float | str | None
    """MAG. Magnitude of stars of which one per square degree is white [default: -2]"""
    panorama: bool | None
    """True. Panorama of all directions"""
    pan: bool | None
    """The same as panorama."""
    fisheye: float | str | None
    """ANGLE. Fisheye: ANGLE degrees in a circle, as for domes"""
    fish: float | str | None
    """The same as fisheye."""
    cube_map: bool | None
    """True. Cube map: six square views from left to right"""
    cube: bool | None
    """The same as cube_map."""
    format: Text | None
    """FMT. Format of the picture [default: by the ending of output, else png]"""
    dt: Text | None
    """The same as format."""
    size: Vector | None
    """W H. Size of the picture in pixels, or in mm, cm, in, pt [default: 1024 768]"""
    sz: Vector | None
    """The same as size."""
    filter: Text | None
    """FILTER. Reconstruction filter from samples to pixels: box, triangle, spline [default: box]"""
    fl: Text | None
    """The same as filter."""
    background: Vector | float | str | None
    """L H S. Background colour: lightness, hue in degrees, saturation; a name, or #rrggbb [default: black]"""
    bg: Vector | float | str | None
    """The same as background."""
    transparent: bool | None
    """True. Transparent background"""
    tb: bool | None
    """The same as transparent."""
    exposure: float | str | None
    """E|auto. Exposure in stops, or auto"""
    ex: float | str | None
    """The same as exposure."""
    tone_curve: Text | None
    """CURVE. Tone curve from light to display: clip, filmic [default: clip]"""
    tc: Text | None
    """The same as tone_curve."""
    pack: bool | None
    """True. Smaller PNG files, which take longer to compress"""
    pz: bool | None
    """The same as pack."""
    channels: str | Sequence[str] | None
    """LIST. Channels to add to an EXR picture, separated by commas: D, time, distance, Z, id, velocity, direction, position, ray"""
    ch: str | Sequence[str] | None
    """The same as channels."""
    look: Text | None
    """LOOK. Look of the picture, in one word: 1988, light, shape [default: light in photon(), warp() and film(), 1988 in the others]"""
    samples: float | str | None
    """N. N x N samples per pixel, 1 to 16 [default: 1]"""
    aa: float | str | None
    """The same as samples."""
    title: Text | None
    """TEXT. Title above the picture, wrapped as needed"""
    caption: Text | None
    """TEXT. Caption below the picture, wrapped as needed; line breaks are kept"""
    cap: Text | None
    """The same as caption."""
    legend: bool | None
    """True. Legend below the picture: spectrum, velocities, Doppler factors"""
    lg: bool | None
    """The same as legend."""
    legend_place: float | str | None
    """PLACE. Place of caption, legend and scale: below, beside, or over a corner, as top-left"""
    lp: float | str | None
    """The same as legend_place."""
    undistorted: bool | None
    """True. Outline of moving bodies as they would look at rest, centred where each body is seen"""
    dl: bool | None
    """The same as undistorted."""
    grid: bool | None
    """True. Grid of coordinates on the ground: in the plane z = 0, or at the lowest point of the scene if that is lower"""
    gr: bool | None
    """The same as grid."""
    map: str | Sequence[str | float] | None
    """QUANTITY LOW HIGH. Instead of light a quantity in false colours, with its scale: D, time, distance, speed, z"""
    iso: str | Sequence[str | float] | None
    """QUANTITY VALUE. Lines of equal values of a quantity over the picture: D, time, distance, speed, z"""
    text_size: float | str | None
    """PIXELS. Size of text in pixels, 4 to 200 [default: 1/40 of the geometric mean of size=]"""
    ts: float | str | None
    """The same as text_size."""
    unit: float | str | None
    """UNIT. What a length of 1 in the scene is: m, km, ls (a light-second) ...; with a number, as '20 m'"""
    speed_of_light: float | str | None
    """SPEED. The speed of light in legends and captions, as 30km/h [default: as in vacuum]"""
    c: float | str | None
    """The same as speed_of_light."""

class Film(Reading, total=False):
    frames: Vector | float | str | None
    """N. Number of frames [default: 100]"""
    fps: Vector | float | str | None
    """RATE. Frames a second, for films in one file [default: 25]"""
    rays: bool | None
    """True. Draw by tracing rays, with mirrors, glass and shadows, instead of the pipe of three programs"""
    warp: bool | None
    """True. Draw views of a panorama, or of numbered ones, instead of a scene"""
    ease: Text | None
    """WORD. How numbers change from one value to the next: linear, smooth [default: linear]"""
    loop: bool | None
    """True. The film repeats: the frame after the last one would be the first"""
    follow: bool | None
    """True. Turn the camera in every frame toward what moves"""
    keys: Text | None
    """FILE. Read values at single frames from FILE: lines such as 120 -ti 0 -ep 0 -5 2"""
    only: Text | None
    """LIST. Draw only these frames: 40..59, or 1,5,9..12"""
    keep: Text | None
    """NAMES. Also keep the frames of a film in these files, frame_%04d.png, and use those that are there"""
    blur: Vector | float | str | None
    """TIME. Motion blur: average the light of the film over TIME, in times between two frames"""
    moments: Vector | float | str | None
    """N. Moments that are averaged with blur= [default: 16]"""
    across: Text | None
    """NAME N. On a page (output FILE.html), a second slider with N values of option NAME"""
    sheet: Vector | float | str | bool | None
    """N. Draw N frames spread over the film, or those of only=, on one sheet"""
    format: Text | None
    """FMT. Format of the film [default: by the ending of output]"""
    dt: Text | None
    """The same as format."""
    look: Text | None
    """LOOK. Look of the picture, in one word: 1988, light, shape [default: light in photon(), warp() and film(), 1988 in the others]"""
    velocity: Values | float | str | None
    """X Y Z. Velocity of all objects, fraction of c [default: the scene's, else 0]"""
    vel: Values | float | str | None
    """The same as velocity."""
    camera_velocity: Values | float | str | None
    """X Y Z. Velocity of the camera in the scene, fraction of c [default: the scene's, else 0]"""
    cv: Values | float | str | None
    """The same as camera_velocity."""
    time: Vector | float | str | None
    """T. Time of the picture on the observer's clock"""
    ti: Vector | float | str | None
    """The same as time."""
    anchor: Vector | float | str | None
    """POINT. Fixed point of the contraction: eye, origin, center or X Y Z"""
    an: Vector | float | str | None
    """The same as anchor."""
    keep_in_view: bool | None
    """True. Keep bodies in view: they appear where the scene has them"""
    in_place: bool | None
    """The same as keep_in_view."""
    in_: bool | None
    """The same as keep_in_view."""
    ahead: bool | None
    """True. View ahead of a moving camera: the picture shows at every speed what it shows at rest"""
    error: Vector | float | str | None
    """ERR. Largest error of edges: milliradians at the eye, or pixels, .15px [default: 0.1]"""
    se: Vector | float | str | None
    """The same as error."""
    color_error: Vector | float | str | None
    """PERCENT. Subdivide also until the interpolated Doppler factor deviates by at most PERCENT, or off [default: 0.15]"""
    sc: Vector | float | str | None
    """The same as color_error."""
    light_error: Vector | float | str | None
    """PERCENT. Subdivide also until the interpolated light of near lamps deviates by at most PERCENT [default: off]"""
    sl: Vector | float | str | None
    """The same as light_error."""
    pieces: Vector | float | str | None
    """N. Cut every edge into N equal pieces, instead of error=, color_error= and light_error="""
    sd: Vector | float | str | None
    """The same as pieces."""
    smooth: bool | None
    """True. Write vertex normals for smooth shading"""
    sm: bool | None
    """The same as smooth."""
    repeat_vertices: bool | None
    """True. Keep colours of faces apart where they share vertices"""
    vr: bool | None
    """The same as repeat_vertices."""
    no_contraction: bool | None
    """True. For teaching: omit Lorentz contraction"""
    nc: bool | None
    """The same as no_contraction."""
    no_flight_time: bool | None
    """True. For teaching: omit the light travel time"""
    measured: Text | None
    """FRAME. Where bodies are at one time of a frame, not where they are seen: camera, scene, or a body"""
    cull: bool | None
    """True. Remove faces that are outside the view of the camera"""
    camera: Text | None
    """NAME. The camera of this name [default: the first without a name, else the first]"""
    cam: Text | None
    """The same as camera."""
    eye: Values | float | str | None
    """X Y Z. Eye point [default: that of the scene's camera]"""
    ep: Values | float | str | None
    """The same as eye."""
    center: Values | float | str | None
    """X Y Z. View centre, shown in the middle of the picture [default: that of the scene's camera, else the scene's middle]"""
    vc: Values | float | str | None
    """The same as center."""
    up: Values | float | str | None
    """X Y Z. Up direction [default: that of the scene's camera, else 0 0 1]"""
    ud: Values | float | str | None
    """The same as up."""
    view_angle: Values | float | str | None
    """A B. Full horizontal and, if given, vertical view angle, in degrees [default: that of the scene's camera, else 40]"""
    va: Values | float | str | None
    """The same as view_angle."""
    orthographic: bool | None
    """True. Orthographic projection"""
    og: bool | None
    """The same as orthographic."""
    wavelengths: bool | None
    """True. Write wavelengths (nm) instead of hues"""
    gw: bool | None
    """The same as wavelengths."""
    brightness: Text | None
    """LAW. Brightness law: report (D), photon (D^3), bolometric (D^4), none [default: report]"""
    br: Text | None
    """The same as brightness."""
    spectral: bool | None
    """True. Shift spectra instead of hues"""
    sp: bool | None
    """The same as spectral."""
    no_doppler: bool | None
    """True. Leave wavelengths as they are"""
    infrared_rule: Vector | float | str | None
    """RULE. Infrared of surfaces of which only the colour is known: measured, constant [default: measured]"""
    no_flux: bool | None
    """True. Leave brightness as it is; with spectral=True omit the factor D^5"""
    color_tolerance: Vector | float | str | None
    """T. Reuse a colour that differs by at most T nm and T percent of value, or with spectral=True by T percent of X, Y and Z; 0: a colour for each vertex"""
    ct: Vector | float | str | None
    """The same as color_tolerance."""
    iris: bool | None
    """True. Iris: scale all values so that the brightest is 1"""
    ir: bool | None
    """The same as iris."""
    light: bool | None
    """True. Light the scene by its lights, moving ones included"""
    li: bool | None
    """The same as light."""
    keep_intensities: bool | None
    """True. Keep values above 1 for the exposure of the renderer"""
    hd: bool | None
    """The same as keep_intensities."""
    no_textures: bool | None
    """True. Give faces with textures their mean colour"""
    sky: Text | None
    """SKY. Sky behind the scene: day, dusk, stars, or a file"""
    sky_turn: Values | float | str | None
    """X Y Z. Turn the sky by these angles about x, then y, then z, in degrees"""
    interpolate_hue: bool | None
    """True. Interpolate hue between corners (default)"""
    ih: bool | None
    """The same as interpolate_hue."""
    interpolate_wavelength: bool | None
    """True. Interpolate wavelength between corners"""
    iw: bool | None
    """The same as interpolate_wavelength."""
    wi: bool | None
    """True. Hues in colour statements are wavelengths in nm; implies interpolate_wavelength=True"""
    vector: bool | None
    """True. Vector graphics instead of pixels, for eps, ps, pdf, svg"""
    vec: bool | None
    """The same as vector."""
    text: bool | None
    """True. Text of captions, legends and grids as text in vector graphics, instead of outlines"""
    txt: bool | None
    """The same as text."""
    size: Values | float | str | None
    """W H. Size of every frame in pixels, or in mm, cm, in, pt [default: 1024 768]"""
    sz: Values | float | str | None
    """The same as size."""
    samples: Vector | float | str | None
    """N. N x N samples per pixel, 1 to 16"""
    aa: Vector | float | str | None
    """The same as samples."""
    filter: Text | None
    """FILTER. Reconstruction filter from samples to pixels: box, triangle, spline"""
    fl: Text | None
    """The same as filter."""
    background: Values | float | str | None
    """L H S. Background colour: lightness, hue in degrees, saturation; a name, or #rrggbb [default: black]"""
    bg: Values | float | str | None
    """The same as background."""
    transparent: bool | None
    """True. Transparent background"""
    tb: bool | None
    """The same as transparent."""
    exposure: Vector | float | str | None
    """E|WORD. Exposure in stops, or auto, hold, follow"""
    ex: Vector | float | str | None
    """The same as exposure."""
    tone_curve: Text | None
    """CURVE. Tone curve from light to display: clip, filmic"""
    tc: Text | None
    """The same as tone_curve."""
    pack: bool | None
    """True. Smaller PNG files, which take longer to compress"""
    pz: bool | None
    """The same as pack."""
    channels: str | Sequence[str] | None
    """LIST. Channels to add to an EXR picture, separated by commas: D, time, distance, Z, id, velocity, direction, position, ray"""
    ch: str | Sequence[str] | None
    """The same as channels."""
    cull_back_faces: bool | None
    """True. Cull back faces, whose corners run clockwise in the picture"""
    cb: bool | None
    """The same as cull_back_faces."""
    wireframe: bool | None
    """True. Wireframe: draw edges of faces as lines, instead of faces; faces still occlude them"""
    wf: bool | None
    """The same as wireframe."""
    edges: bool | None
    """True. Draw edges of faces as black lines, over the faces"""
    ed: bool | None
    """The same as edges."""
    silhouette: bool | None
    """True. Silhouette: of edges only those where a body turns away from the eye, and those of a single face"""
    sil: bool | None
    """The same as silhouette."""
    crease: Vector | float | str | None
    """ANGLE. Of edges only the silhouette and creases of at least ANGLE degrees, 0 to 180"""
    hidden_lines: Vector | float | str | None
    """STYLE. Lines that are hidden by faces: dash, thin [default: not drawn]"""
    hl: Vector | float | str | None
    """The same as hidden_lines."""
    line_color: Values | float | str | None
    """L H S. Colour of the edges, as for background= [default: colours of the faces with wireframe=True, black with edges=True]"""
    lc: Values | float | str | None
    """The same as line_color."""
    line_width: Vector | float | str | None
    """W. Width of edges and wires in pixels"""
    lw: Vector | float | str | None
    """The same as line_width."""
    depth_cue: Values | float | str | bool | None
    """NEAR FAR LEAST. Depth cueing: between the depths NEAR and FAR, light fades linearly into the background, to the fraction LEAST"""
    dc: Values | float | str | bool | None
    """The same as depth_cue."""
    exact: bool | None
    """True. Exact: a ray for every sample, instead of subdivision"""
    xc: bool | None
    """The same as exact."""
    title: Text | None
    """TEXT. Title above the picture, wrapped as needed"""
    caption: Text | None
    """TEXT. Caption below the picture, wrapped as needed; line breaks are kept"""
    cap: Text | None
    """The same as caption."""
    legend: bool | None
    """True. Legend below the picture: spectrum, velocities, Doppler factors"""
    lg: bool | None
    """The same as legend."""
    legend_place: Vector | float | str | None
    """PLACE. Place of caption, legend and scale: below, beside, or over a corner, as top-left"""
    lp: Vector | float | str | None
    """The same as legend_place."""
    undistorted: bool | None
    """True. Outline of moving bodies as they would look at rest, centred where each body is seen"""
    dl: bool | None
    """The same as undistorted."""
    grid: bool | None
    """True. Grid of coordinates on the ground: in the plane z = 0, or at the lowest point of the scene if that is lower"""
    gr: bool | None
    """The same as grid."""
    map: str | Sequence[str | float] | None
    """QUANTITY LOW HIGH. Instead of light a quantity in false colours, with its scale: D, time, distance, speed, z"""
    iso: str | Sequence[str | float] | None
    """QUANTITY VALUE. Lines of equal values of a quantity over the picture: D, time, distance, speed, z"""
    text_size: Vector | float | str | None
    """PIXELS. Size of text in pixels, 4 to 200 [default: 1/40 of the geometric mean of size=]"""
    ts: Vector | float | str | None
    """The same as text_size."""
    unit: Vector | float | str | None
    """UNIT. What a length of 1 in the scene is: m, km, ls (a light-second) ...; with a number, as '20 m'"""
    speed_of_light: Vector | float | str | None
    """SPEED. The speed of light in legends and captions, as 30km/h [default: as in vacuum]"""
    c: Vector | float | str | None
    """The same as speed_of_light."""
    depth: Vector | float | str | None
    """N. Most reflections and refractions along a path"""
    rd: Vector | float | str | None
    """The same as depth."""
    cut_off: Vector | float | str | None
    """PART. Least part of a pixel's light that is followed"""
    rc: Vector | float | str | None
    """The same as cut_off."""
    no_shadows: bool | None
    """True. Without shadows: light reaches surfaces through all others"""
    no_sky_light: bool | None
    """True. The sky does not light the scene"""
    fresnel: bool | None
    """True. Fresnel's equations for mirrors and glass"""
    film_shutter: Vector | float | str | None
    """DISTANCE. Shutter at the film, at this distance behind the pinhole"""
    panorama: bool | None
    """True. Panorama of all directions"""
    pan: bool | None
    """The same as panorama."""
    fisheye: Vector | float | str | None
    """ANGLE. Fisheye: ANGLE degrees in a circle, as for domes"""
    fish: Vector | float | str | None
    """The same as fisheye."""
    cube_map: bool | None
    """True. Cube map: six square views from left to right"""
    cube: bool | None
    """The same as cube_map."""
    stereo: Vector | float | str | None
    """DISTANCE. A picture for each of two eyes at this distance"""
    adaptive: Vector | float | str | None
    """CONTRAST. Adaptive samples: fewer in pixels of less contrast than this"""
    ad: Vector | float | str | None
    """The same as adaptive."""
    radiances: bool | None
    """True. Add channels of radiances at wavelengths to an EXR picture"""
    stage: bool | None
    """True. Stand the scene on a grey ground, under a sky: day, unless sky= gives another"""
    scene: Text | None
    """FILE. Scene whose camera takes the picture"""
    from_: Text | None
    """KIND. Arrangement of directions: panorama, strip, cross, sides [default: panorama]"""
    part: Values | float | str | None
    """WEST EAST SOUTH NORTH. Angles that the panorama shows, in degrees [default: -180 180 -90 90]"""
    basis: Values | float | str | None
    """BASIS T2 T3. Spectra of colours: mixture, or three temperatures [default: mixture]"""
    highlights: Vector | float | str | None
    """STOPS. How much brighter than white clipped highlights of a photograph are, in stops"""
    infrared: Text | None
    """FILE. Panorama of infrared light"""
    infrared_to: Vector | float | str | None
    """NM. Longest wavelength of the infrared panorama, nm [default: 1400]"""
    ultraviolet: Text | None
    """FILE. Panorama of ultraviolet light"""
    ultraviolet_from: Vector | float | str | None
    """NM. Shortest wavelength of the ultraviolet panorama, nm [default: 200]"""
    stars: Vector | float | str | None
    """LIST. Draw the stars of a list in front of the panorama"""
    star_width: Vector | float | str | None
    """PIXELS. Width of stars at half of their maximum, in pixels [default: 1.7]"""
    white: Vector | float | str | None
    """MAG. Magnitude of stars of which one per square degree is white [default: -2]"""
