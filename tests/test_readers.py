"""Meshes written and read back in every format, unit and axis order, and files that must be refused."""

import itertools
import os

import numpy as np
import pytest
import trimesh

from panelsim.errors import PanelsimError
from panelsim.hull.checks import check_mesh
from panelsim.hull.hydrostatics import hydrostatics
from panelsim.hull.immersed import immersed_part
from panelsim.hull.panel_mesh import PanelMesh
from panelsim.hull.readers import read_mesh

SUFFIXES = ("stl", "obj", "ply", "glb", "gdf")
METRES = {"length_unit": "m", "up": "z", "forward": "x"}
GLTF = {"length_unit": "m", "up": "y", "forward": "z"}
SINGLE = 1e-6  # relative: STL, PLY and GLB hold single precision


def hull(twist=0.0):
    """A closed hull whose three extents and two sides all differ, so that no axis can be mistaken."""
    vertices = np.array(
        [
            [-6.0, -1.5, 0.0],
            [-6.0, 2.0, 0.0],
            [-6.0, 2.0, 3.0],
            [-6.0, -1.5, 3.0],
            [7.0, 0.0, 0.0],
            [7.0 + twist, 0.0, 4.0],
        ]
    )
    panels = [[0, 3, 2, 1], [0, 4, 5, 3], [1, 2, 5, 4], [0, 1, 4, 4], [3, 5, 2, 2]]
    return PanelMesh(vertices, np.array(panels))


def volume(mesh):
    return immersed_part(mesh, heel=0.0, trim=0.0, waterline=1e3).volume


def in_hull_axes(suffix):
    return GLTF if suffix == "glb" else METRES


def bounds(mesh):
    return np.array([mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)])


def test_hull_of_these_tests_is_sound_and_lopsided():
    report = check_mesh(hull())
    assert report.problems == ()
    assert not report.symmetric


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_written_mesh_reads_back_with_the_same_volume_and_bounds(tmp_path, suffix):
    mesh = hull()
    path = tmp_path / f"hull.{suffix}"
    mesh.export(path)
    again = read_mesh(path, **in_hull_axes(suffix))
    assert volume(again) == pytest.approx(volume(mesh), rel=SINGLE)
    assert bounds(again) == pytest.approx(bounds(mesh), abs=SINGLE * 13.0)
    assert len(again.vertices) == 6
    assert check_mesh(again).problems == ()
    assert os.listdir(tmp_path) == [path.name]  # nothing half-written is left


@pytest.mark.parametrize("suffix", ["obj", "gdf"])
def test_text_formats_keep_quadrilaterals_and_every_digit(tmp_path, suffix):
    mesh = PanelMesh(hull(twist=1.3).vertices * (1.0 + np.pi / 100.0), hull().panels)
    path = tmp_path / f"hull.{suffix}"
    mesh.export(path)
    again = read_mesh(path, **METRES)
    assert np.array_equal(again.vertices[again.panels], mesh.vertices[mesh.panels])


@pytest.mark.parametrize("suffix", ["stl", "obj", "ply", "glb"])  # a GDF tells its unit, see below
@pytest.mark.parametrize(
    ("unit", "metres"), [("m", 1.0), ("mm", 1e-3), ("cm", 0.01), ("in", 0.0254), (0.3, 0.3)]
)
def test_file_units_become_metres_about_the_origin(tmp_path, suffix, unit, metres):
    mesh = hull()
    origin = np.array([2.0, 0.5, -1.0])
    path = tmp_path / f"hull.{suffix}"
    PanelMesh(mesh.vertices / metres + origin, mesh.panels).export(path)
    axes = in_hull_axes(suffix)
    file_origin = origin[[1, 2, 0]] if suffix == "glb" else origin  # GLB: x to port, y up, z forward
    again = read_mesh(path, **(axes | {"length_unit": unit}), origin=file_origin)
    assert bounds(again) == pytest.approx(bounds(mesh), abs=2 * SINGLE * 13.0)
    assert volume(again) == pytest.approx(volume(mesh), rel=5 * SINGLE)


SIGNED = [sign + axis for sign in ("", "-") for axis in "xyz"]
PAIRS = [(up, forward) for up, forward in itertools.product(SIGNED, SIGNED) if up[-1] != forward[-1]]


@pytest.mark.parametrize(("up", "forward"), PAIRS)
def test_every_axis_order_gives_the_same_right_handed_hull(tmp_path, up, forward):
    def direction(name):
        return np.where(np.arange(3) == "xyz".index(name[-1]), -1.0 if name[0] == "-" else 1.0, 0.0)

    mesh = hull()
    # x e_forward + y (e_up x e_forward) + z e_up: the file as its author would have drawn it.
    port = np.cross(direction(up), direction(forward))
    drawn = mesh.vertices @ np.array([direction(forward), port, direction(up)])
    path = tmp_path / "hull.obj"
    PanelMesh(drawn, mesh.panels).export(path)
    again = read_mesh(path, length_unit="m", up=up, forward=forward)
    # Left and right differ on this hull, so a mirrored result would fail here and be inside out.
    assert np.array_equal(again.vertices[again.panels], mesh.vertices[mesh.panels])
    assert check_mesh(again).outward


def test_ascii_stl_with_two_bodies_and_carriage_returns_is_read(tmp_path):
    text = ""
    for x in (0.0, 5.0):
        body = trimesh.creation.box((4.0, 2.0, 1.0)).apply_translation((x, 0.0, 0.5))
        text += body.export(file_type="stl_ascii")
    path = tmp_path / "two.STL"
    path.write_bytes(text.replace("\n", "\r\n").encode())
    mesh = read_mesh(path, **METRES)
    assert volume(mesh) == pytest.approx(16.0, rel=SINGLE)
    assert check_mesh(mesh).component_count == 2


def test_glb_places_every_body_by_its_transform(tmp_path):
    scene = trimesh.Scene()
    box = trimesh.creation.box((1.0, 1.0, 1.0))
    scene.add_geometry(box, transform=trimesh.transformations.translation_matrix((0.0, 0.0, 10.0)))
    scene.add_geometry(box, transform=trimesh.transformations.scale_matrix(-2.0))  # a mirroring one
    path = tmp_path / "scene.glb"
    path.write_bytes(scene.export(file_type="glb"))
    mesh = read_mesh(path, **GLTF)
    assert bounds(mesh)[:, 0] == pytest.approx([-1.0, 10.5], abs=1e-5)
    assert volume(mesh) == pytest.approx(9.0, rel=SINGLE)


def test_vertices_are_merged_relative_to_the_size_of_the_mesh(tmp_path):
    triangles = hull().vertices[hull().panels]
    for scale in (0.02, 1.0, 50.0):
        soup = scale * triangles.reshape(-1, 3)
        for jitter, count in ((1e-7, 6), (1e-4, 18)):  # of 13 m: below and above 1e-6
            shaken = soup.copy()
            shaken[:, 1] += scale * 13.0 * jitter * (np.arange(20) % 3)
            path = tmp_path / "hull.gdf"
            PanelMesh(shaken, np.arange(20).reshape(5, 4)).export(path)
            assert (len(read_mesh(path, **METRES).vertices) == 6) == (count == 6)


def write_gdf(path, half, *, symmetry="0 1", gravity="9.80665", count=None, header="1.0 {} ULEN GRAV"):
    corners = half.vertices[half.panels].reshape(-1, 3)
    rows = "\n".join(" ".join(f"{value:.9e}" for value in row) for row in corners)
    number = half.panel_count if count is None else count
    path.write_text(f"a hull\n{header.format(gravity)}\n{symmetry} ISX ISY\n{number}\n{rows}\n")


def half_box():
    """The port half of a box 8 x 4 x 2 m that floats 0.5 m deep: z from the waterline."""
    x, y, z = np.meshgrid([-4.0, 4.0], [0.0, 2.0], [-0.5, 1.5], indexing="ij")
    vertices = np.stack([x.ravel(), y.ravel(), z.ravel()], axis=1)
    return PanelMesh(
        vertices, np.array([[0, 1, 3, 2], [4, 6, 7, 5], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
    )


def test_gdf_unfolds_its_symmetry_and_its_waterline_is_placed_by_the_origin(tmp_path):
    path = tmp_path / "box.gdf"
    write_gdf(path, half_box())
    mesh = read_mesh(path, **METRES, origin=(0.0, 0.0, -0.5))
    report = check_mesh(mesh)
    assert report.problems == ()
    assert report.symmetric
    assert hydrostatics(mesh, draft=0.5).displaced_volume == pytest.approx(
        16.0, rel=1e-9
    )  # ten digits written


def test_gdf_with_both_planes_of_symmetry_is_whole(tmp_path):
    vertices = np.maximum(half_box().vertices, [0.0, -np.inf, -np.inf])
    quarter = PanelMesh(vertices, np.delete(half_box().panels, 0, axis=0))
    path = tmp_path / "box.gdf"
    write_gdf(path, quarter, symmetry="1 1")
    mesh = read_mesh(path, **METRES)
    assert check_mesh(mesh).problems == ()
    assert volume(mesh) == pytest.approx(8.0 * 4.0 * 2.0, rel=1e-9)  # ten digits written


def test_gdf_triangle_may_repeat_any_neighbouring_corners(tmp_path):
    path = tmp_path / "hull.gdf"
    for turn in range(4):
        panels = hull().panels.copy()
        panels[3:] = np.roll(panels[3:], turn, axis=1)
        write_gdf(path, PanelMesh(hull().vertices, panels), symmetry="0 0")
        again = read_mesh(path, **METRES)
        assert check_mesh(again).problems == ()
        assert np.all(again.panels[3:, 2] == again.panels[3:, 3])


def test_gdf_in_feet_is_read_as_feet_and_refused_as_metres(tmp_path):
    path = tmp_path / "box.gdf"
    write_gdf(path, half_box(), gravity="32.174")
    assert volume(read_mesh(path, length_unit="ft", up="z", forward="x")) == pytest.approx(64.0 * 0.3048**3)
    with pytest.raises(PanelsimError, match="is in feet, by its gravity"):
        read_mesh(path, **METRES)


def test_half_hull_is_mirrored_only_if_it_is_half(tmp_path):
    path = tmp_path / "half.stl"
    half_box().export(path)
    mesh = read_mesh(path, **METRES, symmetry="centreline")
    assert check_mesh(mesh).problems == ()
    assert check_mesh(mesh).symmetric
    assert volume(mesh) == pytest.approx(64.0, rel=SINGLE)
    with pytest.raises(PanelsimError, match="more than one side"):
        read_mesh(path, **METRES, symmetry="centreline", origin=(0.0, 1.0, 0.0))


def test_open_and_inside_out_meshes_are_read_as_they_are(tmp_path):
    path = tmp_path / "hull.ply"
    PanelMesh(hull().vertices, hull().panels[:-1, ::-1]).export(path)
    report = check_mesh(read_mesh(path, **METRES))
    assert not report.closed
    assert not report.outward


@pytest.mark.parametrize("share", [0.0, 0.02, 0.3, 0.5, 0.9, 0.99])
@pytest.mark.parametrize("suffix", SUFFIXES)
def test_truncated_file_is_refused(tmp_path, suffix, share):
    path = tmp_path / f"hull.{suffix}"
    PanelMesh(half_box().vertices * np.pi, half_box().panels).export(path)
    content = path.read_bytes()
    path.write_bytes(content[: int(share * len(content))])
    try:
        mesh = read_mesh(path, **in_hull_axes(suffix))
    except PanelsimError as error:
        assert path.name in str(error)
    else:
        # An OBJ file announces no length, and the last digits of a number may be lost in text: what is
        # then read is another surface, and open.
        assert suffix in ("obj", "gdf")
        assert check_mesh(mesh).problems


@pytest.mark.parametrize("share", [0.3, 0.6, 0.9])
@pytest.mark.parametrize(
    ("suffix", "options"), [("stl", {"file_type": "stl_ascii"}), ("ply", {"encoding": "ascii"})]
)
def test_truncated_text_file_is_refused(tmp_path, suffix, options, share):
    path = tmp_path / f"ball.{suffix}"
    content = trimesh.creation.icosphere(subdivisions=2).export(**({"file_type": suffix} | options))
    content = content.encode() if isinstance(content, str) else content
    path.write_bytes(content)
    assert read_mesh(path, **METRES).panel_count == 320
    path.write_bytes(content[: int(share * len(content))])
    with pytest.raises(PanelsimError, match=r"ball\..* (is cut short|cannot be read)"):
        read_mesh(path, **METRES)


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("hull.step", b"ISO-10303-21;", "not a kind of mesh file"),
        ("hull", b"", "not a kind of mesh file"),
        ("hull.stl", b"\x00\x01\x02 nonsense" * 20, "cut short or not an STL"),
        ("hull.stl", b"solid empty\nendsolid empty\n", "no surface|cannot be read"),
        ("hull.ply", b"not a ply file", "cannot be read"),
        ("hull.glb", b"glTF nonsense", "cannot be read"),
        ("hull.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\n", "no surface"),
        ("hull.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "names a vertex that is not in it"),
        ("hull.obj", b"v 0 0 0\nf 0 1 1\n", "Line 2 of hull.obj"),
        ("hull.obj", b"v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n", "not numbers"),
        ("hull.obj", b"v 0 0 0\nv 1 0 inf\nv 0 1 0\nf 1 2 3\n", "not numbers"),
        ("hull.gdf", b"title\nno numbers here\n0 0\n1\n", "not a low-order GDF"),
        ("hull.gdf", b"title\n1 9.81\n0 -1\n1\n" + b"0 " * 12, "symmetry that panelsim does not read"),
        ("hull.gdf", b"title\n1 9.81\n0 0\n2\n" + b"0 " * 12, "cut short or has a wrong panel count"),
    ],
)
def test_file_that_is_no_mesh_is_refused_by_name(tmp_path, name, content, message):
    path = tmp_path / name
    path.write_bytes(content)
    with pytest.raises(PanelsimError, match=message) as caught:
        read_mesh(path, **METRES)
    assert name in str(caught.value)


def test_missing_file_and_folder_are_refused(tmp_path):
    with pytest.raises(PanelsimError, match="no such mesh file"):
        read_mesh(tmp_path / "none.stl", **METRES)
    (tmp_path / "folder.stl").mkdir()
    with pytest.raises(PanelsimError, match="no such mesh file"):
        read_mesh(tmp_path / "folder.stl", **METRES)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"length_unit": "km"}, "Unknown length unit"),
        ({"length_unit": 0.0}, "Unknown length unit"),
        ({"length_unit": np.nan}, "Unknown length unit"),
        ({"up": "w"}, "Unknown axis for up"),
        ({"forward": "Z "}, "Unknown axis for forward"),
        ({"up": "z", "forward": "-z"}, "along the same file axis"),
        ({"origin": (0.0, 1.0)}, "origin is not a point"),
        ({"symmetry": "x"}, "Unknown symmetry"),
        ({"length_unit": "mm"}, "13 file units of 0.001 m make 0.013 m"),
        ({"length_unit": 100.0}, "13 file units of 100 m make 1300 m"),
    ],
)
def test_units_and_axes_that_make_no_sense_are_refused(tmp_path, changes, message):
    path = tmp_path / "hull.obj"
    hull().export(path)
    with pytest.raises(PanelsimError, match=message):
        read_mesh(path, **(METRES | changes))


def test_units_and_axes_have_no_defaults(tmp_path):
    with pytest.raises(TypeError, match="length_unit"):
        read_mesh(tmp_path / "hull.glb")


def test_obj_reads_comments_textures_negative_indices_and_polygons(tmp_path):
    path = tmp_path / "hull.obj"
    path.write_text(
        "mtllib none.mtl\no hull\nv 0 0 0\nv 4 0 0 1 0 0\nv 4 3 0 # a corner\nv 2 5 0\nv 0 3 0\nv 9 9 9\n"
        "vt 0 0\nvn 0 0 1\nusemtl none\nf -6/1/1 -5/1/1 -4//1 -3 -2\n"
    )
    mesh = read_mesh(path, **METRES)
    assert mesh.panel_count == 3
    assert mesh.area.sum() == pytest.approx(4 * 3 + 0.5 * 4 * 2)
    assert len(mesh.vertices) == 5  # the one that no face uses is left out


def test_export_refuses_unknown_suffix_and_missing_folder(tmp_path):
    with pytest.raises(PanelsimError, match="cannot be written to this kind"):
        hull().export(tmp_path / "hull.step")
    with pytest.raises(PanelsimError, match="no such folder"):
        hull().export(tmp_path / "none" / "hull.stl")


def test_exported_triangles_take_the_shorter_diagonal(tmp_path):
    vertices = np.array([[0.0, 0, 0], [3, 1, 0], [4, 4, 1], [1, 3, 0]])
    path = tmp_path / "panel.stl"
    for turn in range(4):
        PanelMesh(vertices, np.roll([[0, 1, 2, 3]], turn, axis=1)).export(path)
        found = read_mesh(path, **METRES)
        shared = set(found.panels[0]) & set(found.panels[1])
        assert sorted(found.vertices[list(shared), 0]) == [1.0, 3.0]
