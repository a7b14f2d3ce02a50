/// Variants of a case: how their texts are read, which are refused and why.

#include "common/cases/variant.hpp"

#include "common/base/error.hpp"
#include "common/cases/reader.hpp"

#include <gmock/gmock.h>

namespace diptych::cases {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

const std::string block =
    "[parameters]\nf = 0.8\n[mesh]\ncells = [4, 4, 4]\n[material]\nmodel = 'neo-hookean'\n"
    "density = 1\nshear_modulus = 1\nlame = 1\n[time]\nend = 1\n[sph]\nkappa = 0.75\n";

std::vector<VariantCase> added(const std::vector<std::string>& texts) {
  std::vector<VariantCase> variants;
  for (const std::string& text : texts)
    add_variant(variant_from_text(text), variants);
  return variants;
}

std::string refusal_of(const std::vector<std::string>& texts) {
  try {
    added(texts);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "";
}

std::string refusal_of_file(const std::string& text) {
  try {
    case_from_text(block + text, "case.toml");
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Variant, OfATextHasANameAndSettingsOfItsMethod) {
  const auto variants = added({"sph.kappa=1.2", "wide: sph.kappa=1.2; sph.kernel = quintic-spline",
                               "corrected: scheme.face_correction=1/6 mesh.cells=[8, 8, 8]"});
  EXPECT_EQ(variants[0].name, "kappa=1.2");
  EXPECT_EQ(variants[0].method, "sph");
  EXPECT_EQ(variants[1].name, "wide");
  EXPECT_THAT(variants[1].set, ElementsAre("sph.kappa=1.2", "sph.kernel = quintic-spline"));
  EXPECT_EQ(variants[2].method, "") << "of both";
  EXPECT_THAT(variants[2].set, ElementsAre("scheme.face_correction=1/6", "mesh.cells=[8, 8, 8]"));
  EXPECT_EQ(added({"scheme.face_correction=1/6 fvm.stencil=sbp"})[0].name,
            "face_correction=1_6+stencil=sbp")
      << "a folder";
}

TEST(Variant, OfAFileIsReadWithTheCase) {
  const Case setup =
      case_from_text(block +
                         "[[variant]]\nname = 'sbp'\nset = ['sph.gradient=sbp', 'sph.kappa=1.2']\n"
                         "[[variant]]\nname = 'sbp'\nset = ['fvm.stencil=sbp']\n"
                         "[[variant]]\nname = 'corrected'\nmethod = 'fvm'\n"
                         "set = ['scheme.face_correction=1/6']\n",
                     "case.toml");
  ASSERT_EQ(setup.variants.size(), 3u);
  EXPECT_EQ(setup.variants[0].method, "sph");
  EXPECT_EQ(setup.variants[1].method, "fvm") << "one name for either method";
  EXPECT_EQ(setup.variants[2].method, "fvm");
}

TEST(Variant, ThatMakesNoColumnIsRefusedWithItsPlace) {
  EXPECT_THAT(refusal_of({"sph.kapa=1.2"}),
              AllOf(StartsWith("--with sph.kapa=1.2: "), HasSubstr("did you mean 'sph.kappa'?")));
  EXPECT_THAT(refusal_of({"a: sph.kappa=1.2 fvm.stencil=sbp"}), HasSubstr("make two variants"));
  EXPECT_THAT(refusal_of({"a: sph.kappa=1.2", "a: time.cfl=0.5"}), HasSubstr("is there already"));
  EXPECT_THAT(refusal_of({"a/b: sph.kappa=1.2"}), HasSubstr("letters, digits"));
  EXPECT_THAT(refusal_of({"kappa"}), HasSubstr("write key=value"));
  EXPECT_THAT(refusal_of({"a:"}), HasSubstr("sets nothing"));
  EXPECT_THAT(refusal_of({"record.file=1"}), HasSubstr("no run reads"));
  EXPECT_THAT(refusal_of_file("[[variant]]\nname = 'a'\nset = ['sph.kapa=1']\n"),
              AllOf(StartsWith("case.toml:14"), HasSubstr("did you mean 'sph.kappa'?")));
  EXPECT_THAT(refusal_of_file("[[variant]]\nname = 'a'\nmethod = 'fvm'\nset = ['sph.kappa=1']\n"),
              HasSubstr("of fvm sets keys of sph"));
}

TEST(Variant, IsToldWhatTheCaseHasByItself) {
  const Case setup = case_from_text(block, "case.toml");
  const auto in_common = [&](const std::string& text) {
    const VariantCase variant = added({text})[0];
    return setting_in_common(variant, setup, case_from_text(block, "case.toml", variant.set));
  };
  EXPECT_EQ(in_common("sph.kappa=0.75"), "sph.kappa = 0.75") << "in the file";
  EXPECT_EQ(in_common("fvm.stencil=auto"), "fvm.stencil = \"auto\"") << "by default";
  EXPECT_EQ(in_common("parameters.f=0.8"), "parameters.f = 0.8");
  EXPECT_THAT(in_common("sph.kappa=1.2"), IsEmpty());
}

}  // namespace
}  // namespace diptych::cases
