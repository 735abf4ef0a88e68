#!/usr/bin/env python3
"""That floors.py and function_length.py see what they are for: made-up trees and sources, each with one offence."""

import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import floors  # noqa: E402
import function_length  # noqa: E402

# A small tree in which every include looks down.
TREE = {
    "base/result.h": "#include <string>\n",
    "shaders/shared/pm.h": "",
    "shaders/surface/pool.glsl": '#include "shaders/shared/pm.h"\n',
    "shaders/pm/sector.glsl": '#include "shaders/surface/pool.glsl"\n',
    "shaders/pm/vertex.comp": '#include "sector.glsl"\n',
    "shaders/prep/vertex.comp": '#include "shaders/surface/pool.glsl"\n',
    "shaders/supple_surface.glsl": "",
    "gpu/device.h": '#include "base/result.h"\n#include <vulkan/vulkan_core.h>\n',
    "cage/character.h": '#include "base/result.h"\n',
    "cage/gltf/reader.cpp": '#include "cage/character.h"\n#include <nlohmann/json.hpp>\n#include <fstream>\n',
    "skinning/pose.h": '#include "cage/character.h"\n',
    "surface/grid.h": '#include "cage/character.h"\n#include "shaders/shared/pm.h"\n',
    "surface/prep/scheme.h": '#include "surface/grid.h"\n',
    "surface/pm/scheme.cpp": '#include "surface/grid.h"\n#include "shaders/pm_vertex_comp.h"\n',
    "surface/schemes.cpp": '#include "surface/prep/scheme.h"\n',
    "runtime/include/supple/supple.h": "#include <vulkan/vulkan_core.h>\n",
    "runtime/group.h": '#include "supple/supple.h"\n#include "skinning/pose.h"\n#include "surface/grid.h"\n',
    "host/figure.cpp": '#include "supple/supple.h"\n#include "base/result.h"\n#include <GLFW/glfw3.h>\n',
    "host/shaders/draw.vert": '#include "supple_surface.glsl"\n',
    "tools/supple/main.cpp": '#include "host/figure.cpp"\n#include "runtime/group.h"\n#include <nlohmann/json.hpp>\n',
    "samples/minimal/main.cpp": "#include <supple/supple.h>\n",
    "tests/surface/grid_test.cpp": '#include "surface/grid.h"\n#include "tools/supple/main.cpp"\n',
    "build/release/anything.cpp": '#include "nowhere.h"\n',
}

# An include that is refused: where, of what, and the words that say why.
OFFENCES = [
    ("base/result.h", '"gpu/device.h"', "looks up, from base/ to gpu/"),
    ("base/result.h", '"../gpu/device.h"', "looks up, from base/ to gpu/"),
    ("gpu/device.h", '"cage/character.h"', "looks sideways, from gpu/ to cage/"),
    ("cage/character.h", '"cage/gltf/reader.cpp"', "looks up, from cage/ to cage/gltf/"),
    ("skinning/pose.h", '"surface/grid.h"', "looks sideways, from skinning/ to surface/"),
    ("surface/grid.h", '"skinning/pose.h"', "looks sideways, from surface/ to skinning/"),
    ("surface/grid.h", '"surface/prep/scheme.h"', "looks up, from surface/ to surface/prep/"),
    ("surface/pm/scheme.cpp", '"surface/prep/scheme.h"', "looks sideways, from surface/pm/ to surface/prep/"),
    ("surface/grid.h", "<supple/supple.h>", "looks up, from surface/ to runtime/include/"),
    ("runtime/include/supple/supple.h", '"base/result.h"', "runtime/include/ may include only"),
    ("runtime/group.h", '"host/figure.cpp"', "looks up, from runtime/ to host/"),
    ("host/figure.cpp", '"runtime/group.h"', "host/ may include only"),
    ("host/figure.cpp", '"cage/character.h"', "host/ may include only"),
    ("host/shaders/draw.vert", '"shaders/surface/pool.glsl"', "host/ may include only"),
    ("samples/minimal/main.cpp", '"cage/character.h"', "samples/ may include only"),
    ("tools/supple/main.cpp", '"tests/surface/grid_test.cpp"', "looks up, from tools/supple/ to tests/"),
    ("shaders/shared/pm.h", '"shaders/surface/pool.glsl"', "looks up, from shaders/shared/ to shaders/surface/"),
    ("shaders/prep/vertex.comp", '"shaders/pm/sector.glsl"', "looks sideways, from shaders/prep/ to shaders/pm/"),
    ("shaders/prep/vertex.comp", '"../pm/sector.glsl"', "looks sideways, from shaders/prep/ to shaders/pm/"),
    ("cage/character.h", "<vulkan/vulkan.h>", "is only for gpu/"),
    ("cage/character.h", "<nlohmann/json.hpp>", "is only for cage/gltf/"),
    ("runtime/group.h", "<fstream>", "is only for cage/gltf/"),
    ("runtime/group.h", "<GLFW/glfw3.h>", "is only for hosts"),
    ("surface/grid.h", '"surface/gird.h"', "is no file of the tree"),
    ("attic/old.cpp", '"base/result.h"', "the folder has no floor"),
]


def write(root, tree):
    for path, text in tree.items():
        file = os.path.join(root, path)
        os.makedirs(os.path.dirname(file), exist_ok=True)
        with open(file, "w", encoding="utf-8") as out:
            out.write(text)


class Floors(unittest.TestCase):
    def offences(self, tree, exceptions=None):
        with tempfile.TemporaryDirectory() as root:
            write(root, tree)
            return floors.offences(root, exceptions or {})

    def test_a_tree_that_looks_down_passes(self):
        self.assertEqual(self.offences(TREE), [])

    def test_one_offence_is_refused_with_its_line(self):
        for path, included, words in OFFENCES:
            with self.subTest(path=path, included=included):
                text = TREE.get(path, "")
                lines = self.offences({**TREE, path: f"{text}  #  include {included}\n"})
                self.assertEqual(len(lines), 1, lines)
                line = 1 if "floor" in words else text.count("\n") + 1
                self.assertTrue(lines[0].startswith(f"{path}:{line}: "), lines[0])
                self.assertIn(words, lines[0])

    def test_an_exception_holds_for_one_include(self):
        tree = {**TREE, "surface/pm/scheme.cpp": '#include "surface/prep/scheme.h"\n'}
        exception = {("surface/pm/scheme.cpp", "surface/prep/scheme.h"): "a reason"}
        self.assertEqual(self.offences(tree, exception), [])
        tree["surface/blend/scheme.cpp"] = '#include "surface/prep/scheme.h"\n'
        self.assertEqual(len(self.offences(tree, exception)), 1)

    def test_an_exception_that_is_not_needed_is_refused(self):
        lines = self.offences(TREE, {("surface/pm/scheme.cpp", "surface/prep/scheme.h"): "a reason"})
        self.assertEqual(len(lines), 1, lines)
        self.assertIn("needs no exception", lines[0])


class FunctionLength(unittest.TestCase):
    def lengths(self, text):
        return {name: (first, lines) for name, first, lines in function_length.functions(text)}

    def test_functions_of_every_form_are_measured(self):
        self.assertEqual(self.lengths('''// Not one: void comment() {
namespace supple {
namespace {

constexpr int kTable[] = {1, 2, 3};
enum class Kind { a, b };
static_assert(sizeof(Kind) == Kind{4}.size());

template <class T>
Result<std::vector<T>> read(std::span<const T> from,
                            T with = T{0}) {
    const char* text = "} // not the end {";
    const auto each = [&](int i) {
        if (i > 0) {
            return R"(})";
        }
    };
    return {};
}

class Writer final : public Base<int (*)()> {
public:
    Writer(int a)
        : a_{a}, b_(a),
          c_{a} {
        write('{');
    }
    ~Writer() { close(); }
    bool operator==(const Writer& other) const {
        return a_ == other.a_;
    }

private:
    int a_ = 1'000;
#define OPEN void macro() {
    struct Entry {
        int first() const { return 0; }
    };
};

} // namespace

void Writer::finish() && {
}

} // namespace supple
'''), {"read": (9, 11), "Writer": (23, 5), "~Writer": (28, 1), "operator==": (29, 3), "first": (37, 1),
       "Writer::finish": (43, 2)})

    def test_one_line_too_many_is_refused_and_an_old_exception_too(self):
        for lines, refused in [(function_length.LIMIT, 0), (function_length.LIMIT + 1, 1)]:
            with tempfile.TemporaryDirectory() as root:
                write(root, {"runtime/group.cpp": "\nvoid record() {\n" + "    step();\n" * (lines - 2) + "}\n"})
                found = function_length.offences(root, set())
                self.assertEqual(len(found), refused, found)
                self.assertEqual(function_length.offences(root, {"runtime/group.cpp record"}) == [], bool(refused))
                if refused:
                    self.assertEqual(found, ["runtime/group.cpp:2: record has 61 lines, more than 60"])

    def test_every_exception_has_a_reason(self):
        with tempfile.TemporaryDirectory() as root:
            write(root, {"with": "# words\nrecord -- a table\n", "without": "record --\n"})
            self.assertEqual(function_length.read_list(os.path.join(root, "with")), {"record"})
            self.assertRaises(ValueError, function_length.read_list, os.path.join(root, "without"))


if __name__ == "__main__":
    unittest.main()
