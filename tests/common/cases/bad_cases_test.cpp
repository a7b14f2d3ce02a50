/// Wrong case files: each must be refused with its place and with what to do.

#include "common/base/error.hpp"
#include "common/cases/reader.hpp"
#include "tests/trials.hpp"

#include <gmock/gmock.h>
#include <string>

namespace diptych::cases {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// A good case, cut into sections so that a wrong one can take the place of each.
const std::string mesh = "[mesh]\ncells = [2, 2, 2]\n";
const std::string material =
    "[material]\nmodel = 'neo-hookean'\ndensity = 1100\nyoungs_modulus = 17e6\n"
    "poissons_ratio = 0.3\n";
const std::string time = "[time]\nend = 1.0\n";

struct BadCase {
  std::string name;
  std::string text;
  std::string place;    ///< "line:column: ", or what follows the file
  std::string message;  ///< a part of it
};

class BadCases : public testing::TestWithParam<BadCase> {};

TEST_P(BadCases, AreRefusedAtTheirPlace) {
  const BadCase& bad = GetParam();
  tests::Trials trials("hostile inputs");
  try {
    case_from_text(bad.text, "case.toml");
    FAIL() << "accepted";
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.what(), StartsWith("case.toml:" + bad.place));
    EXPECT_THAT(error.what(), HasSubstr(bad.message));
    EXPECT_NE(std::string(error.what()).back(), '.');
  }
  trials.add(!HasFailure());
}

std::string material_with(const std::string& lines) {
  return mesh + time + "[material]\n" + lines;  // line 6 on
}
std::string after(const std::string& lines) {
  return mesh + material + time + lines;
}  // 10 on

const std::string probe =
    "[[probe]]\nname = 'tip'\nunit = 'm'\nkind = 'point'\nat = [0, 0, 0]\nquantity = 'ux'\n";

const BadCase of_form[] = {
    {"empty", "", "1:1: ", "mesh.cells is missing; write cells = [4, 4, 24]"},
    {"nul", std::string("a = \"x\0y\"", 9), "1:", "not TOML"},
    {"not_utf8", "title = \"\xff\"", "1:", "utf-8"},
    {"unterminated", "title = \"abc", "1:", "not TOML"},
    {"comma_decimal", "[time]\nend = 1,5\n", "2:8: ", "not TOML"},
    {"leading_zero", "[time]\nend = 010\n", "2:", "leading zeroes"},
    {"duplicate_key", "[time]\nend = 1\nend = 2\n", "3:", "cannot redefine"},
    {"duplicate_section", "[time]\nend = 1\n[time]\ncfl = 1\n", "3:", "cannot redefine"},
    {"overflow", "[time]\nend = 1e400\n", "2:", "1e400"},
    {"nan", "[time]\nend = nan\n", "2:7: ", "not a finite number"},
    {"minus_inf", "[time]\nend = -inf\n", "2:7: ", "not a finite number"},
    {"long_line", "title = \"" + std::string(2 << 20, 'x') + "\"", " ", "at most 1048576"},
    {"nested", "a = " + std::string(5000, '['), "1:", "nested more than 32"},
    {"unknown_key", "[mesh]\ncels = [1, 1, 1]\n",
     "2:1: ", "unknown key 'mesh.cels'; did you mean 'mesh.cells'?"},
    {"unknown_section", "[meshes]\ncells = [1, 1, 1]\n", "1:2: ", "did you mean 'mesh'?"},
    {"other_section", mesh + "cfl = 0.5\n", "3:1: ", "did you mean 'time.cfl'?"},
    {"top_level", "end = 1\n", "1:1: ", "did you mean 'time.end'?"},
    {"quoted_path", "\"time.end\" = 1\n", "1:1: ", "unknown key"},
    {"index_as_name", "[mesh.0]\ncells = [1, 1, 1]\n", "1:", "unknown key 'mesh.0'"},
    {"table_for_list", "[boundary]\ngroup = 'a'\n", "1:1: ", "write [[boundary]]"},
    {"number_in_tables", "probe = [3]\n" + after(""), "1:10: ", "write [[probe]]"},
    {"group_twice", after("[[boundary]]\ngroup = ['x_min', 'x_min']\ntype = 'fixed'\n"),
     "11:9: ", "names 'x_min' twice"},
    {"no_motion",
     after("[[boundary]]\ngroup = 'x_min'\ntype = 'traction'\nvalue = 'manufactured'\n"),
     "13:9: ", "needs a motion"},
    {"probe_without_name",
     after("[[probe]]\nname = ''\nunit = 'm'\nkind = 'point'\nat = [0, 0, 0]\nquantity = 'ux'\n"),
     "11:8: ", "is empty"},
    {"probe_twice", after(probe + probe), "1", "a probe is already called 'tip'"},
    {"out_of_plane",
     "[mesh]\nelement = 'quadrilateral'\ncells = [2, 2]\n" + material + time +
         "[initial]\ndeformation_gradient = [[1, 0, 0.1], [0, 1, 0], [0, 0, 1]]\n",
     "12:", "leaves the plane"},
    {"list_for_table", "[[mesh]]\ncells = [1, 1, 1]\n", "1:", "write [mesh]"},
    {"value_for_table", "mesh = 3\n", "1:8: ", "mesh is the number 3"},
    {"flag_for_number", mesh + material + "[time]\nend = true\n", "9:7: ", "time.end is true; it"},
    {"date_for_number", mesh + material + "[time]\nend = 2000-01-01\n", "9:7: ", "a date"},
    {"real_for_integer", after("[output]\nframes = 2.5\n"), "11:10: ", "it takes integer"},
    {"broken_integer", after("[output]\nframes = '5/2'\n"), "11:10: ", "not an integer"},
    {"text_for_flag", after("[output]\nfields = 'yes'\n"), "11:10: ", "it takes true or false"},
    {"menu", after("[scheme]\nlimiter = 'sign-preservin'\n"),
     "11:11: ", "did you mean 'sign-preserving'?"},
};

const BadCase of_numbers[] = {
    {"end_zero", mesh + material + "[time]\nend = 0\n", "9:7: ", "time.end = 0 s"},
    {"end_negative", mesh + material + "[time]\nend = -0.5\n", "9:7: ", "it must be > 0"},
    {"denormal", mesh + material + "[time]\nend = 1e-310\n", "9:7: ", "too small"},
    {"cfl", after("cfl = 11\n"), "10:7: ", "in (0, 10]"},
    {"frames", after("[output]\nframes = 0\n"), "11:10: ", "in [1, 1000000]"},
    {"parameter_order", "[parameters]\nb = 'a'\na = 1\n", "2:6: ", "unknown name 'a'"},
    {"parameter_of_itself", "[parameters]\na = 'a'\n", "2:6: ", "unknown name 'a'"},
    {"parameter_name", "[parameters]\nx = 1\n", "2:1: ", "already has a meaning"},
    {"parameter_function", "[parameters]\nsin = 1\n", "2:1: ", "already has a meaning"},
    {"parameter_division", "[parameters]\na = 0\nb = '1/a'\n", "3:6: ", "not a finite number"},
    {"number_of_place", mesh + material + "[time]\nend = '2*x'\n",
     "9:10: ", "a number may use parameters and pi only"},
    {"multi_line", mesh + material + "[time]\nend = \"\"\"\n1 +\n  foo\"\"\"\n",
     "11:3: ", "unknown name 'foo'"},
    {"cells_count", "[mesh]\ncells = [2, 2]\n" + material + time,
     "2:9: ", "has 2 entries; in this 3-D case it takes 3"},
    {"cells_zero", "[mesh]\ncells = [2, 0, 2]\n" + material + time, "2:13: ", "mesh.cells = 0"},
    {"cells_huge", "[mesh]\ncells = [1000000, 1000000, 1000000]\n" + material + time,
     "2:9: ", "1e+18 cells"},
    {"plane_vector", "[mesh]\nelement = 'triangle'\ncells = [2, 2]\nupper = [1, 1, 1]\n",
     "4:9: ", "in this 2-D case it takes 2"},
    {"box_inside_out", "[mesh]\ncells = [2, 2, 2]\nupper = [1, -1, 1]\n",
     "3:9: ", "in direction y"},
};

const BadCase of_idle_keys[] = {
    {"single_exact", after("[scheme]\nprecision = 'single'\nimpedance = 'exact'\n"),
     "11:13: ", "has no exact impedance"},
    {"mesh_missing", "[mesh]\nelement = 'triangle'\nfile = 'no.msh'\n", "3:8: ", "does not exist"},
    {"mesh_kind", "[mesh]\nelement = 'triangle'\nfile = 'no.stl'\n", "3:8: ", ".msh nor a .geo"},
    {"mesh_element", "[mesh]\nfile = 'no.msh'\n", "1:1: ", "mesh.element is missing"},
    {"mesh_twice", "[mesh]\nelement = 'triangle'\nfile = 'no.msh'\ncells = [1, 1]\n",
     "4:9: ", "no effect with mesh.file"},
    {"seed", mesh + "seed = 3\n", "3:8: ", "no effect without mesh.perturbation"},
    {"size", mesh + "size = 3\n", "3:8: ", "no effect on a box"},
    {"limiter", after("[scheme]\nreconstruction = 'none'\nlimiter = 'sign-preserving'\n"),
     "12:11: ", "no effect"},
    {"fixed_value", after("[[boundary]]\ngroup = 'a'\ntype = 'fixed'\nvalue = [0, 0, 0]\n"),
     "13:9: ", "no effect on type = \"fixed\""},
    {"traction_value", after("[[boundary]]\ngroup = 'a'\ntype = 'traction'\n"),
     "10:1: ", "boundary.0.value is missing"},
    {"pressure_value", after("[[boundary]]\ngroup = 'a'\ntype = 'pressure'\nvalue = [0, 0, 1]\n"),
     "13:9: ", "one expression"},
    {"no_groups", after("[[boundary]]\ngroup = []\ntype = 'fixed'\n"), "11:9: ", "is empty"},
    {"contradiction",
     after("[[boundary]]\ngroup = ['a', 'b']\ntype = 'fixed'\n[[boundary]]\ngroup = 'b'\n"
           "type = 'symmetry'\n"),
     "13:1: ", "already of type fixed (line 10)"},
    {"wall_point", after("[[boundary]]\ngroup = 'a'\ntype = 'rigid-wall'\nnormal = [0, 0, 1]\n"),
     "10:1: ", "boundary.0.point is missing"},
    {"wall_normal",
     after("[[boundary]]\ngroup = 'a'\ntype = 'rigid-wall'\npoint = [0, 0, 0]\n"
           "normal = [0, 0, 0]\n"),
     "14:10: ", "is no direction"},
    {"point_of_fixed", after("[[boundary]]\ngroup = 'a'\ntype = 'fixed'\npoint = [0, 0, 0]\n"),
     "13:9: ", "it is for rigid-wall"},
    {"two_walls",
     after("[[boundary]]\ngroup = 'a'\ntype = 'rigid-wall'\npoint = [0, 0, 0]\n"
           "normal = [0, 0, 1]\n[[boundary]]\ngroup = 'a'\ntype = 'rigid-wall'\n"
           "point = [0, 0, 0]\nnormal = [0, 0, 1]\n"),
     "15:1: ", "already of type rigid-wall"},
    {"expression", after("[initial]\nvelocity = [0, '10*zz', 0]\n"),
     "11:20: ", "unknown name 'zz'; did you mean"},
    {"tensor_rows", after("[exact]\nstress = [[1, 0, 0], [0, 1, 0]]\n"),
     "11:10: ", "has 2 entries"},
};

const BadCase of_material[] = {
    {"no_material", mesh + time, "1:1: ", "material.density is missing"},
    {"density", material_with("model = 'neo-hookean'\ndensity = 0\n"), "7:11: ", "> 0"},
    {"no_pair", material_with("density = 1\nmodel = 'neo-hookean'\n"), "5:1: ", "found: none"},
    {"wrong_pair",
     material_with("density = 1\nmodel = 'neo-hookean'\nyoungs_modulus = 1\nlame = 1\n"),
     "5:1: ", "found: youngs_modulus, lame"},
    {"three", material_with("density = 1\nyoungs_modulus = 1\npoissons_ratio = 0.3\nlame = 1\n"),
     "5:1: ", "takes one pair of constants"},
    {"nu_half", material_with("density = 1\nyoungs_modulus = 1\npoissons_ratio = 0.5\n"),
     "8:18: ", "use at most 0.4999"},
    {"nu_minus_one", material_with("density = 1\nyoungs_modulus = 1\npoissons_ratio = -1\n"),
     "8:18: ", "in (-1, 0.5)"},
    {"no_ratio", material_with("density = 1\nyoungs_modulus = 1\npoissons_ratio = 0.3\n"),
     "5:1: ", "material.zeta_ratio is missing"},
    {"ratio_of_neo_hookean",
     material_with("model = 'neo-hookean'\ndensity = 1\nshear_modulus = 1\nlame = 1\n"
                   "zeta_ratio = 0.1\n"),
     "10:14: ", "no effect on neo-hookean"},
    {"not_polyconvex",
     material_with("density = 1\nyoungs_modulus = 17e6\npoissons_ratio = 0.3\nzeta_ratio = 0.9\n"),
     "9:14: ", "for nu = 0.3 (polyconvexity, eq. 4); use less than 0.75"},
    {"just_not_polyconvex",
     material_with("density = 1\nshear_modulus = 1\nlame = 1.5\nzeta_ratio = 0.75\n"),
     "9:14: ", "use less than 0.75"},
    {"ratio_above_one", material_with("density = 1\nshear_modulus = 1\nlame = 1\nzeta_ratio = 2\n"),
     "9:14: ", "in [0, 1)"},
    {"auxetic",
     material_with("model = 'neo-hookean'\ndensity = 1\nyoungs_modulus = 1\npoissons_ratio = 0\n"),
     "9:18: ", "use a Poisson's ratio above 0 or an isochoric model"},
    {"isochoric_bulk",
     material_with("model = 'neo-hookean-isochoric'\ndensity = 1\nshear_modulus = 3\nlame = -2\n"),
     "9:8: ", "bulk modulus"},
    {"empty_branch", after("[[material.branch]]\n"), "10:1: ", "is empty; give beta_C + tau_C"},
    {"half_branch", after("[[material.branch]]\nbeta_C = 1\n"),
     "10:1: ", "material.branch.0.tau_C is missing"},
    {"negative_beta", after("[[material.branch]]\nbeta_C = -1\ntau_C = 1\n"), "11:10: ", "> 0"},
    {"zero_tau", after("[[material.branch]]\nbeta_C = 1\ntau_C = 0\n"), "12:9: ", "tau_C = 0 s"},
    {"branch_of_zeta", after("[[material.branch]]\nbeta_G = 1\ntau_G = 1\n"),
     "11:10: ", "zeta = 0 in this material"},
};

const std::string q = "[functions.q]\ntype = 'zener_mode'\nwave_number_squared = 1\ndensity = 1\n";

const BadCase of_functions[] = {
    {"type", "[functions.q]\ntype = 'zener_mod'\n", "2:8: ", "did you mean 'zener_mode'?"},
    {"key", q + "modulos = 1\n", "5:1: ", "did you mean 'functions.*.modulus'?"},
    {"times", q + "modulus = 1\nbranch_moduli = [1]\n", "1:1: ", "one time for each modulus"},
    {"modulus", q + "modulus = -1\n", "5:11: ", "functions.q.modulus = -1 Pa"},
    {"taken", "[parameters]\nq_dot = 1\n" + q + "modulus = 1\n", "3:", "'q_dot' is defined twice"},
    {"reserved", "[functions.t]\ntype = 'zener_mode'\n", "1:", "already has a meaning"},
};

const std::string on_x = "[[boundary]]\ntype = \"fixed\"\n";
const std::string mean_u = "[[probe]]\nname = \"u\"\nunit = \"m\"\nkind = \"mean\"\n";

const BadCase of_types[] = {
    {"group_number", after(on_x + "group = 5\n"), "12:9: ",
     "boundary.0.group is the number 5; it takes name or list of names, as in group = [\"x_min\", "
     "\"y_min\"]"},
    {"group_of_number", after(on_x + "group = [\"x_min\", 5]\n"), "12:9: ",
     "boundary.0.group is a list of 2; it takes name or list of names, as in group = [\"x_min\", "
     "\"y_min\"]"},
    {"group_empty_name", after(on_x + "group = [\"\"]\n"),
     "12:9: ", "boundary.0.group holds an empty name; name a group of the mesh"},
    {"group_none", after(on_x + "group = []\n"),
     "12:9: ", "boundary.0.group is empty; name a group of the mesh, as in group = \"x_min\""},
    {"group_twice", after(on_x + "group = [\"x_min\", \"x_min\"]\n"),
     "12:9: ", "boundary.0.group names 'x_min' twice"},
    {"text_number", "title = 5\n",
     "1:9: ", "title is the number 5; it takes text, as in title = \"swinging cube, P mode\""},
    {"text_control", "title = \"a\\u0007\"\n", "1:9: ", "title holds control characters"},
    {"flag_text", after("[output]\nfields = \"yes\"\n"),
     "11:10: ", "output.fields is the text 'yes'; it takes true or false, as in fields = false"},
    {"list_number", "[mesh]\ncells = 4\n",
     "2:9: ", "mesh.cells is the number 4; it takes list of integers, as in cells = [4, 4, 24]"},
    {"list_long", "[mesh]\ncells = [1, 2, 3, 4, 5]\n",
     "2:9: ", "mesh.cells has 5 entries; in this 3-D case it takes 3"},
    {"integer_half", "[mesh]\ncells = [1.5, 1, 1]\n",
     "2:10: ", "mesh.cells is the number 1.5; it takes list of integers, as in cells = [4, 4, 24]"},
    {"integer_huge", mesh + material + "[time]\nend = 1\nmax_steps = 1e30\n",
     "10:13: ", "time.max_steps is the number 1e+30; it takes integer, as in max_steps = 1000"},
    {"section_number", "mesh = 5\n", "1:8: ", "mesh is the number 5; write [mesh]"},
    {"section_list", "[[mesh]]\ncells = [1, 1, 1]\n", "1:1: ", "mesh is a list of 1; write [mesh]"},
    {"list_section", after("[boundary]\ngroup = \"x_min\"\n"),
     "10:1: ", "boundary is a table; write [[boundary]]"},
    {"date", mesh + material + "[time]\nend = 1979-05-27\n",
     "9:7: ", "time.end is a date or time; it takes number, as in end = \"1.25*2*pi/omega\""},
    {"name_of_column",
     after("[[probe]]\nname = \"a/b\"\nunit = \"m\"\nkind = \"mean\"\nquantity = \"ux\"\n"),
     "11:8: ",
     "probe.0.name = 'a/b' holds one of []/ and cannot be part of the header of a column"},
    {"name_empty",
     after("[[probe]]\nname = \"\"\nunit = \"m\"\nkind = \"mean\"\nquantity = \"ux\"\n"),
     "11:8: ", "probe.0.name is empty; give it a text for the column's header"},
    {"probe_taken",
     after("[[probe]]\nname = \"kinetic energy\"\nunit = \"J\"\nkind = \"mean\"\n"
           "quantity = \"ux\"\n"),
     "11:8: ",
     "probe.0.name = 'kinetic energy' is what every run has under this name, in its "
     "tables and columns; rename the probe"},
    {"probe_part",
     after("[[probe]]\nname = \"u, final\"\nunit = \"m\"\nkind = \"mean\"\nquantity = "
           "\"ux\"\n" +
           mean_u + "quantity = \"ux\"\n"),
     "10:1: ",
     "'u, final' is what tables and bounds call a part of the probe 'u' (line 15); "
     "rename one"},
    {"probe_twice", after(mean_u + "quantity = \"ux\"\n" + mean_u + "quantity = \"uy\"\n"),
     "15:1: ", "a probe is already called 'u' (line 10); rename one"},
    {"probe_at", after(mean_u + "quantity = \"ux\"\nat = [0, 0, 0]\n"),
     "15:6: ", "probe.0.at has no effect on kind = \"mean\"; remove it"},
    {"probe_direction", after(mean_u + "quantity = \"ux\"\ndirection = [0, 0, 1]\n"),
     "15:13: ", "probe.0.direction has no effect on kind = \"mean\"; remove it"},
    {"probe_field", after(mean_u + "quantity = \"ux\"\n[parameters]\nmises = 1\n"), "10:1: ",
     "'mises' is a field in the quantities of probes; rename the parameter or function 'mises'"},
    {"reaction_quantity",
     after("[[probe]]\nname = \"R\"\nunit = \"N\"\nkind = \"reaction\"\nquantity = \"ux\"\n"),
     "14:12: ", "probe.0.quantity has no effect on kind = \"reaction\"; remove it"},
    {"point_group",
     after("[[probe]]\nname = \"R\"\nunit = \"m\"\nkind = \"point\"\nquantity = \"ux\"\nat = [0, "
           "0, 0]\ngroup = \"x_min\"\n"),
     "16:9: ", "probe.0.group has no effect on kind = \"point\"; remove it"},
    {"text_flag", "title = true\n",
     "1:9: ", "title is true; it takes text, as in title = \"swinging cube, P mode\""},
    {"text_off", "title = false\n",
     "1:9: ", "title is false; it takes text, as in title = \"swinging cube, P mode\""},
    {"menu_number", "[mesh]\nelement = 5\n", "2:11: ",
     "mesh.element is the number 5; it takes name (hexahedron, tetrahedron, quadrilateral, "
     "triangle), as in element = \"tetrahedron\""},
    {"names_number", after("[expect]\nvariants = 5\n"), "11:12: ",
     "expect.variants is the number 5; it takes list of texts, as in variants = "
     "[\"sph.kappa=0.75\"]"},
    {"unmet_variant",
     after("[expect]\nvariants = [\"a\"]\n[[expect.unmet]]\nmethod = \"sph\"\nvariant = "
           "\"b\"\nbecause = \"c\"\n"),
     "14:11: ", "= 'b' is none of expect.variants"},
    {"unmet_step",
     after("[expect]\n[[expect.unmet]]\nmethod = \"sph\"\nby_step = 3\nbecause = \"c\"\n"),
     "13:11: ", "has no effect without stops; remove it"},
};

void PrintTo(const BadCase& bad, std::ostream* stream) {
  *stream << bad.name;
}

std::string name_of(const testing::TestParamInfo<BadCase>& info) {
  return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(Form, BadCases, testing::ValuesIn(of_form), name_of);
INSTANTIATE_TEST_SUITE_P(Numbers, BadCases, testing::ValuesIn(of_numbers), name_of);
INSTANTIATE_TEST_SUITE_P(IdleKeys, BadCases, testing::ValuesIn(of_idle_keys), name_of);
INSTANTIATE_TEST_SUITE_P(Material, BadCases, testing::ValuesIn(of_material), name_of);
INSTANTIATE_TEST_SUITE_P(Types, BadCases, testing::ValuesIn(of_types), name_of);
INSTANTIATE_TEST_SUITE_P(Functions, BadCases, testing::ValuesIn(of_functions), name_of);

TEST(Overrides, OfAListNameAnEntryThatIsThere) {
  const std::string two =
      after("[[probe]]\nname = \"u\"\nunit = \"m\"\nkind = \"mean\"\nquantity = \"ux\"\n");
  EXPECT_EQ(case_from_text(two, "case.toml", {"probe.0.name=\"w\""}).probes[0].name, "w");
  const auto refusal = [&](const std::string& entry) -> std::string {
    try {
      case_from_text(two, "case.toml", {"probe." + entry + ".name=\"w\""});
      return "accepted";
    } catch (const base::InputError& error) {
      return error.what();
    }
  };
  for (const char* entry : {"1", "12345678901234567890"})
    EXPECT_THAT(refusal(entry), HasSubstr("is no entry of this list; it has 1")) << entry;
  for (const char* entry : {"first", "-1", "1a", " "})
    EXPECT_THAT(refusal(entry), HasSubstr("unknown key 'probe.")) << entry;
}

}  // namespace
}  // namespace diptych::cases
