#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Counts functions and files that one reads to follow something through the program, and the files that an addition
touches.

usage: walks.py [--files] [--before]

--files: names the files, too
--before: at commit 9162326, with the names of that time, instead of the working tree

A walk is a list of functions, in the order in which something goes through them. Counted are its functions; the files
that define them; the changes of file from one function to the next; those of them that return to a file left before;
the functions whose body has at most 2 lines; and the files read, which are also those that define a type that stands
in the head of a function. --files names the files read. A function is written `name`, or `Class::name` or
`file.h:name` where several files define that name. It has to be named in the body of one before it on the walk,
unless it stands behind ">": LAMMPS calls it, or it is called by a pointer, an operator or a constructor.

What an addition touches are the files that its recipe (tests/recipes) writes. Before there were recipes it is
the files whose code names what was there of its kind.
"""
import os
import re
import subprocess
import sys
import tarfile
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
BEFORE = "9162326"

# From what the fix, or its /kk form, hands to the engine to a force: common to several walks.
SEARCH_BEFORE = """
    EngineOn::choose NearWall::choose NearWall::start_choice NearList::choose NearList::select {select}
    NearChoice::places NearChoice::check NearChoice::may_keep NearChoice::find NearChoice::keep_after_all
    seen_at_choice touch.h:can_touch wall_list.h:can_touch ListStore::make ListStore::gather touch.h:gather
    gather_for gather_within for_each_within CellsInBall::next insert_code > GatherWork::operator() WallLists::put"""
SEARCH_NOW = """
    BroadPhase::choose CandidateSelector::choose CandidateSelector::select {select}
    CandidateTest::centres CandidateTest::check CandidateTest::coarse_test CandidateTest::is_near CandidateTest::refine
    query_sphere_at can_touch FeatureListStore::make feature_list.h:gather gather_within for_each_within
    CellsInBall::next insert_code > GatherWork::operator() FeatureLists::put"""
STEP_BEFORE = """
    EngineOn::start EngineOn::collect EngineOn::run EngineMesh::work force_settings job_of EngineOn::start_law
    > joint_step.h:start_law {step} > LawStep::single LawStep::several single_contact several_contacts centre_of
    query_sphere_of WallLists::holds touch touch_with share search search_in find_in_list find_contacts_in add_feature
    WallGeometry::closest_point closest_point_on closest_on_face CornerRule::solve apply_law state_at add_motion
    add_contacts begin_memory transfer_of handed_on GranularModel::evaluate HertzNormal::force law_step.h:give
    ResultColumns::put StridedView::add"""
STEP_NOW = """
    EngineOn::compute EngineOn::mesh_work force_settings job_of EngineOn::run_law > run_compiled_law {step}
    > MeshStep::fast_path centre_of query_sphere_of FeatureLists::holds find_listed find_in_list add_feature
    MeshGeometry::closest_point closest_point_on closest_on_face > MeshStep::general_path any_contacts narrow_phase
    find_filtered find_contacts_in share_overlap CornerRule::solve apply_law state_at
    add_motion add_contacts begin_memory transfer_of handed_on GranularModel::evaluate TouchingNormal::force add_force
    ResultColumns::put StridedView::add"""
RECORD_BEFORE = """
    > MeshPart::MeshPart > SharedWall::SharedWall SharedWall::read read_stl read_stl_bytes read_binary read_stl_text
    Placement::apply weld weld_points sort_facets build_edges number_flat_edges_last measure_mesh > FixWallLsdcd::rebuild SharedWall::build
    SharedWall::whole with_images SharedWall::build_block build_cpu.cpp:build_grid build_grid_on
    wall_features.cpp:make_features make_face make_edge face_record WallFeatures::view move_flat"""

WALKS = {
    "from x of a sphere to its force": {
        "before": """
            FixWallLsdcd::pre_force FixWallLsdcd::begin_step FixWallLsdcd::start FixWallLsdcd::spheres
            FixWallLsdcd::step_settings FixWallLsdcd::choose_if_due > FixWallLsdcd::post_force
            FixWallLsdcd::collect """
            + SEARCH_BEFORE.format(select="CpuBackend::select CpuBackend::look_again")
            + STEP_BEFORE.format(step="CpuBackend::step CpuBackend::step_run CpuBackend::step_several"),
        "now": """
            FixWallLsdcd::pre_force FixWallLsdcd::begin FixWallLsdcd::begin_step FixWallLsdcd::spheres
            FixWallLsdcd::spheres_in_atom Wall::begin Wall::submit Wall::step_settings
            Wall::choose_if_due WallEngine::choose_if_due CandidateSchedule::next EngineOn::choose"""
            + SEARCH_NOW.format(select="selection_cpu.h:run selection_cpu.h:refine")
            + " EngineOn::submit > FixWallLsdcd::post_force FixWallLsdcd::finish_step Wall::finish EngineOn::collect"
            + STEP_NOW.format(step="step_cpu.h:run_step run_fast_path > run_left"),
    },
    "from -k on to the force of a sphere": {
        "before": """
            lsdcdkkplugin.cpp:lammpsplugin_init host_matches kokkos_matches add_plain_styles add_style create_fix
            FixWallLsdcdKokkos::FixWallLsdcdKokkos FixWallLsdcd::FixWallLsdcd > make_engine_on
            engine_cuda.cu:make_cuda_engine_in_place > FixWallLsdcd::pre_force FixWallLsdcd::begin_step FixWallLsdcdKokkos::start
            > FixWallLsdcdKokkos::pre_reverse EngineOn::ready
            EngineOn::begin_beside CudaBeside::ready CudaBeside::begin
            FixWallLsdcdKokkos::give_step FixWallLsdcdKokkos::spheres host_kokkos.h:rows_of FixWallLsdcd::step_settings
            FixWallLsdcd::choose_if_due > FixWallLsdcd::post_force FixWallLsdcdKokkos::collect
            FixWallLsdcd::collect """
            + SEARCH_BEFORE.format(select="CudaBackend::select start_mark cuda_mark > cuda_second_look.h:operator()")
            + STEP_BEFORE.format(step="CudaBackend::step start_step cuda_step do_several"),
        "now": """
            plugin_guard.cpp:lammpsplugin_init host_matches ask_mpi plugin_guard.cpp:kokkos_matches
            open_styles > lsdcdkkplugin.cpp:lsdcd_add_styles lsdcdkkplugin.cpp:kokkos_matches add_plain_styles add_style create_fix
            > GuardedFixKokkos::GuardedFixKokkos > FixWallLsdcdKokkos::FixWallLsdcdKokkos FixWallLsdcd::FixWallLsdcd
            > make_engine_on engine_cuda.cu:make_cuda_engine_in_place > FixWallLsdcd::pre_force FixWallLsdcd::begin
            FixWallLsdcdKokkos::begin_step FixWallLsdcdKokkos::spheres host_kokkos.h:rows_of Wall::begin
            EngineOn::begin CudaSideStream::ready > FixWallLsdcdKokkos::pre_reverse Wall::submit
            Wall::step_settings Wall::choose_if_due WallEngine::choose_if_due CandidateSchedule::next EngineOn::choose
            EngineOn::where_step_runs CudaSideStream::begin"""
            + SEARCH_NOW.format(select="selection_gpu.h:run > selection_gpu.h:operator()")
            + " EngineOn::submit"
            + STEP_NOW.format(step="step_gpu.h:run_step > step_gpu.h:operator() run_general_path")
            + " > FixWallLsdcd::post_force FixWallLsdcdKokkos::finish_step FixWallLsdcd::finish_step Wall::finish",
    },
    "from a triangle of a file to its record": {
        "before": RECORD_BEFORE,
        "now": """
            > MeshPart::MeshPart > MeshGrid::MeshGrid MeshGrid::read read_mesh.cpp:read_mesh read_stl_mesh
            read_stl read_stl_bytes read_binary read_stl_text Placement::apply weld weld.cpp:join weld_points weld.cpp:connect sort_facets
            build_edges number_flat_edges_last measure_mesh > GridManager::rebuild MeshGrid::build
            MeshGrid::whole with_images load_or_build_grid > build_cpu.cpp:build_grid build_grid_on
            mesh_features.cpp:make_features make_face_record edge_record make_segment put_inward face_record MeshFeatures::view > move_flat""",
    },
    "from the words rolling cdt to the torque": {
        "before": """
            read_rolling Tokens::choice > law_for > with_added_law > add_contacts AddedModel::evaluate
            CdtRolling::contact_torque""",
        "now": """
            read_rolling read_beside_classic sub_models make_table read_numbers > law_for > with_added_law family_of
            > add_contacts AddedModel::evaluate Rolling::act Rolling::act_as CdtRolling::contact_torque""",
    },
    "from a call of the library to a distance": {
        "before": """
            lsdcd_query_host at_c_border checked_query arrays_of answer_points answer_on_cpu with_point_work
            NearFirstCpu::run CpuBackend::for_each NearFirstCpu::answer_block PointWork::sphere brick_place_of
            BrickTable::at PointWork::far PointWork::answer nearest_from nearest_in_cell WallDistances::feature
            closest_point_on PointWork::keep""",
        "now": """
            lsdcd_query_host guard checked_query query_in_parts query_part arrays_of point_sides.cpp:query_with_sides
            query_then_fill tree_query.cpp:query_tree TreeQuery::run TreeQuery::search_along_curve TreeQuery::is_far
            CutoffBoxes::may_be_within TreeQuery::find_nearest TriangleTree::nearest TriangleTree::search_in_float_plain
            TriangleTree::search_in_float TriangleTree::search_leaf TreeView::attempt TreeView::exact TreeView::segment
            TreeAnswers::store""",
    },
}


def blank(match):
    return re.sub(r"[^\n]", " ", match[0])


def code_of(text):
    """Without comments and strings."""
    return re.sub(r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])+'", blank, text, flags=re.S)


def closing(text, at, opens, closes):
    """Where the bracket that opens at `at` closes."""
    depth = 0
    for i in range(at, len(text)):
        depth += (text[i] == opens) - (text[i] == closes)
        if depth == 0:
            return i
    return len(text) - 1


KEYWORDS = {"if", "for", "while", "switch", "return", "catch", "sizeof", "decltype"}
CALL = re.compile(r"(?:(\w+)(?:<[^<>()]*>)?::)?(operator\(\)|~?[A-Za-z_]\w*)\s*\(")
# What may stand between the arguments of a function and its body.
BODY = re.compile(r"\s*(?:(?:const|override|noexcept|final)\b\s*|->\s*[\w:<>*& ]+?\s*(?=\{)|"
                  r":(?!:)[^;{}]*(?:\{[^{}]*\}[^;{}]*)*?(?=\{))*\{")
TYPE = re.compile(r"^(?:template <[^\n]*> )?(?:struct|class|enum class|enum|union)\s+(?:alignas\(\w+\)\s+)?(\w+)"
                  r"\s*(?::[^;{}]*)?\{|^using (\w+) =", re.M)
CLASS = re.compile(r"\b(?:struct|class)\s+(?:alignas\(\w+\)\s+)?(\w+)\s*(?::[^;{}]*)?\{")


class Sources:
    def __init__(self, files):
        """files: {path: text}"""
        self.functions = {}    # name: [(path, class or "", head, body)]
        self.types = {}        # name: files that define it
        for path, text in files.items():
            code = code_of(text)
            classes = [(m[1], m.start(), closing(code, m.end() - 1, "{", "}")) for m in CLASS.finditer(code)]
            for m in TYPE.finditer(code):
                self.types.setdefault(m[1] or m[2], set()).add(path)
            for m in CALL.finditer(code):
                if m[2] in KEYWORDS:
                    continue
                body = BODY.match(code, closing(code, m.end() - 1, "(", ")") + 1)
                if not body:
                    continue
                inside = [c for c in classes if c[1] < m.start() < c[2]]
                owner = m[1] or (min(inside, key=lambda c: c[2] - c[1])[0] if inside else "")
                # From the line of its name's beginning, which has the type that it returns.
                begin = code.rfind("\n", 0, m.start()) + 1
                end = closing(code, body.end() - 1, "{", "}")
                self.functions.setdefault(m[2], []).append((path, owner, code[begin:body.end()], code[body.end():end]))

    def find(self, named):
        """The file of a function, and head and body of its overloads there."""
        place, name = named.split(":", 1) if re.match(r"\w+\.\w+:", named) else ("", named)
        owner, _, name = name.rpartition("::")
        found = [f for f in self.functions.get(name, ()) if (not owner or f[1] == owner) and
                 (not place or os.path.basename(f[0]) == place)]
        files = {f[0] for f in found}
        if len(files) != 1:
            raise SystemExit(f"{named} is defined in {len(files)} files: {' '.join(sorted(files))}")
        return files.pop(), [f[2:] for f in found]

    def count(self, names):
        """A walk's functions, files, changes of file, returns to a file left before, functions of at most 2 lines."""
        found = [self.find(named) for named in names.split() if named != ">"]
        files = [path for path, _ in found]
        changes = [k for k in range(1, len(files)) if files[k] != files[k - 1]]
        returns = [k for k in changes if files[k] in files[:k]]
        short = [1 for _, overloads in found if max(lines_of(body) for _, body in overloads) <= 2]
        return len(files), len(set(files)), len(changes), len(returns), len(short)

    def walk(self, names):
        """The files on a walk."""
        files, seen, by_itself = set(), "", True
        for named in names.split():
            if named == ">":
                by_itself = True
                continue
            path, overloads = self.find(named)
            name = re.split("[:]+", named)[-1]
            if not by_itself and not re.search(rf"\b{name}\b", seen):
                raise SystemExit(f"{named} is not called on the walk before it")
            by_itself = False
            files.add(path)
            for head, body in overloads:
                seen += body
                for word in set(re.findall(r"[A-Za-z_]\w*", head)):
                    files |= self.types.get(word, set()) if len(self.types.get(word, ())) == 1 else set()
        return files


def lines_of(body):
    """Lines of a function's body with something on them."""
    return sum(1 for line in body.split("\n") if line.strip(" }"))


def is_source(path):
    return re.match(r"(src|kokkos)/.*\.(h|cuh|cpp|cu)(\.in)?$", path)


def tree_sources(root):
    files = {}
    for top in ("src", "kokkos"):
        for folder, _, names in os.walk(os.path.join(root, top)):
            for name in names:
                path = os.path.relpath(os.path.join(folder, name), root)
                if is_source(path):
                    with open(os.path.join(root, path), encoding="utf-8") as f:
                        files[path] = f.read()
    return files


def commit_sources(root, commit):
    git = subprocess.Popen(["git", "-C", root, "archive", commit, "src", "kokkos"], stdout=subprocess.PIPE)
    files = {}
    with tarfile.open(fileobj=git.stdout, mode="r|") as tar:
        for member in tar:
            if is_source(member.name):
                files[member.name] = tar.extractfile(member).read().decode("utf-8")
    if git.wait() != 0:
        raise SystemExit(f"git has no commit {commit}")
    return files


# What is added: the script that adds one, and what names one of its kind before there were scripts.
ADDITIONS = {
    "a rolling model with history": ("rolling_model.py", r"epsd2|Epsd2|AddedRolling|\bsds\b|SdsRolling|has_rolling"),
    "a mesh format": ("mesh_format.py", r"\bread_stl\(|MeshFormat|mesh_format"),
}


def written_by(recipe):
    """The files of src that a recipe writes."""
    with tempfile.TemporaryDirectory() as out:
        subprocess.run([sys.executable, os.path.join(ROOT, "tests", "recipes", recipe), os.path.join(ROOT, "src"),
                        out], check=True)
        return {os.path.join("src", os.path.relpath(os.path.join(folder, name), out))
                for folder, _, names in os.walk(out) for name in names}


def naming(files, pattern):
    """Those whose code, with its strings and without its comments, names something."""
    comments = re.compile(r"//[^\n]*|/\*.*?\*/", re.S)
    return {path for path, text in files.items() if re.search(pattern, comments.sub("", text))}


def main():
    if set(sys.argv[1:]) - {"--files", "--before"}:
        sys.exit(__doc__)
    before = "--before" in sys.argv
    files = commit_sources(ROOT, BEFORE) if before else tree_sources(ROOT)
    sources = Sources(files)
    when = "before" if before else "now"
    print("functions  files  changes  returns  short  files read")
    for what, names in WALKS.items():
        show("{:9} {:6} {:8} {:8} {:6}".format(*sources.count(names[when])), sources.walk(names[when]), what)
    for what, (recipe, pattern) in ADDITIONS.items():
        show(" " * 41, naming(files, pattern) if before else written_by(recipe), f"touched by {what}")


def show(counts, files, what):
    print(f"{counts} {len(files):11}  {what}")
    if "--files" in sys.argv:
        print("".join(f"       {path}\n" for path in sorted(files)), end="")


if __name__ == "__main__":
    main()
