/// The page in a browser: nothing is cut at the width of a screen or of a phone, marks on the edge
/// of a plot are whole, plots and pictures are saved as files. Built where Chromium was found.

#include "postprocess/report/atlas_page.hpp"
#include "postprocess/report/curve_page.hpp"
#include "postprocess/report/study_report.hpp"
#include "tests/report/browser.hpp"
#include "tests/report/sample_study.hpp"

#include <gtest/gtest.h>

namespace diptych::report {
namespace {

using test::seen_in;
using test::with_witness;

class Page : public testing::Test {
 protected:
  /// With a history that begins and ends on the edges of its plots, and more fields than fit.
  std::string report() const {
    StudyReport study = test::full_study();
    for (io::RunSummary& run : study.runs) {
      for (const char* field : {"cofactor", "jacobian", "viscous_C", "viscous_G"})
        run.errors[field] = {1e-3, 2e-3, 3e-3};
    }
    return report_html(study, script_);
  }
  std::string curves() const {
    const Curve a{"SPH", {0.1, 1, 10}, {1e-2, 1e-3, 1e-4}}, b{"FVM", {0.2, 2, 0}, {1e-2, 1e-3, 1}};
    const std::string table(300, 'x');
    return curve_page("Work", "", "Too coarse.", {{"Error", "seconds", "error", {a, b}, true}},
                      table, script_);
  }
  static std::string atlas() {
    AtlasPicture picture{"sph", "nodes", "nu", {{"lattice"}, {"nodes moved by 30 %"}}, {}, {}};
    for (int i = 0; i < 40; ++i)
      picture.columns.push_back({std::to_string(i)});
    picture.cells.assign(2, std::vector<AtlasCell>(40, {"wrong", "energy residual", "stopped"}));
    return atlas_page("Map", "", "Of 80 points none is stable.", {picture}, std::string(300, 'x'));
  }
  const std::string script_ = chart_script(chart_script_path());
};

/// Every part of the page that is wider than its place, and tables that can not be scrolled to
/// their last column with the first one still in sight.
const char* const measuring = R"(<script>
addEventListener('load', async () => {
  await wait(300);
  const width = document.documentElement.clientWidth;
  const cut = [], scrolled = [];
  const describe = (element) => `${element.tagName} ${element.className || element.id} ${element.textContent.slice(0, 30)}`;
  for (const element of document.querySelectorAll('body *')) {
    const { left, right, width: w } = element.getBoundingClientRect();
    const isSeen = w > 1 && getComputedStyle(element).visibility !== 'hidden' && !element.matches('.choice input, .choice legend');
    if (isSeen && !element.closest('.scroll table, .scroll pre, .scroll svg') && (right > width + 0.5 || left < -0.5)) cut.push(describe(element));
  }
  for (const place of document.querySelectorAll('.scroll')) {
    const box = place.getBoundingClientRect();
    if (place.scrollWidth <= place.clientWidth) continue;
    place.scrollLeft = 1e6;
    if (!['auto', 'scroll'].includes(getComputedStyle(place).overflowX)) cut.push(`${describe(place)} does not scroll`);
    if (getComputedStyle(place).backgroundImage === 'none') cut.push(`${describe(place)} does not tell that it scrolls`);
    const row = place.querySelector('tbody tr');
    if (row) {
      const [first, last] = [row.firstElementChild, row.lastElementChild].map((cell) => cell.getBoundingClientRect());
      if (last.right > box.right + 1) cut.push(`${describe(place)}: the last column stays out of sight`);
      if (Math.abs(first.left - box.left) > 1) cut.push(`${describe(place)}: the first column scrolls away`);
      if (first.width > 0.5 * box.width) cut.push(`${describe(place)}: the first column takes half of the width`);
    }
    scrolled.push(place.closest('section').id);
  }
  report({ faults, cut, scrolled, width, needed: document.documentElement.scrollWidth });
});
</script>)";

TEST_F(Page, CutsNothingOnAScreenAndOnAPhone) {
  for (const int width : {1400, 800, 390}) {
    for (const std::string& page : {report(), curves(), atlas()}) {
      const nlohmann::json seen = seen_in(with_witness(page, measuring), width);
      ASSERT_TRUE(seen.is_object()) << "the page did not get to its end";
      EXPECT_EQ(seen["faults"], nlohmann::json::array()) << width;
      EXPECT_EQ(seen["cut"], nlohmann::json::array()) << width;
      EXPECT_LE(seen["needed"].get<int>(), seen["width"].get<int>()) << "scrolls sideways";
      EXPECT_FALSE(seen["scrolled"].empty()) << "nothing here was too wide";
    }
  }
}

TEST_F(Page, WouldSeeATableThatIsCut) {
  std::string page = report();
  page.insert(page.find("</style>"), ".scroll { overflow: hidden !important; }");
  const nlohmann::json seen = seen_in(with_witness(page, measuring), 390);
  ASSERT_TRUE(seen.is_object());
  EXPECT_NE(seen["cut"].dump().find("does not scroll"), std::string::npos);
}

/// Looks at the four tips of every filled mark: nothing but paper or grid there is a mark that is
/// cut.
const char* const tips = R"(<script>
addEventListener('load', async () => {
  await wait(300);
  const cut = [];
  let onEdge = 0;
  const bytes = (name) => { const n = parseInt(plots.colour(name).slice(1), 16); return [n >> 16, (n >> 8) & 255, n & 255].join(); };
  const blank = [bytes('grid'), bytes('grid-faint')];
  for (const canvas of document.querySelectorAll('.plot canvas')) {
    const chart = Chart.getChart(canvas);
    const { left, right, top, bottom } = chart.chartArea;
    const ratio = chart.currentDevicePixelRatio;
    const isBlank = (x, y) => {
      const [r, g, b, a] = canvas.getContext('2d').getImageData(Math.round(x * ratio), Math.round(y * ratio), 1, 1).data;
      return a < 128 || blank.includes([r, g, b].join());
    };
    chart.data.datasets.forEach((set, index) => chart.getDatasetMeta(index).data.forEach(({ x, y, options }, i) => {
      if (!(options.radius > 2) || !['circle', 'rectRot'].includes(options.pointStyle)) return;
      const r = 0.6 * options.radius;
      if (Math.min(x - left, right - x, y - top, bottom - y) < r) onEdge += 1;
      if ([[r, 0], [-r, 0], [0, r], [0, -r]].some(([u, v]) => isBlank(x + u, y + v))) cut.push(`${canvas.id}, ${set.label}, point ${i}`);
    }));
  }
  report({ faults, cut, onEdge });
});
</script>)";

TEST_F(Page, ShowsMarksOnTheEdgeOfAPlotWhole) {
  for (const std::string& page : {report(), curves()}) {
    const nlohmann::json seen = seen_in(with_witness(page, tips), 800);
    ASSERT_TRUE(seen.is_object());
    EXPECT_EQ(seen["faults"], nlohmann::json::array());
    EXPECT_EQ(seen["cut"], nlohmann::json::array());
    if (page == report()) {
      EXPECT_GT(seen["onEdge"].get<int>(), 3) << "no mark lies on an edge here";
    }
  }
}

/// Saves every plot and every picture, and reads the files.
const char* const saving = R"(<script>
const files = [];
URL.createObjectURL = (blob) => { files.push({ blob }); return 'blob:none'; };
HTMLAnchorElement.prototype.click = function () { files.at(-1).name = this.download; };
addEventListener('load', async () => {
  await wait(300);
  const failed = [], names = [];
  for (const canvas of document.querySelectorAll('.plot canvas')) {
    const expect = (condition, what) => { if (!condition) failed.push(`${canvas.id}: ${what}`); };
    const chart = Chart.getChart(canvas);
    const figure = canvas.closest('figure');
    const { left, top, width, height } = chart.chartArea;
    const before = canvas.toDataURL();
    const save = async () => {
      figure.querySelector('.save').click();
      const { blob, name } = files.at(-1);
      const text = await blob.text();
      const picture = new DOMParser().parseFromString(text, 'image/svg+xml');
      expect(!picture.querySelector('parsererror') && picture.documentElement.localName === 'svg', `no SVG: ${text.slice(0, 200)}`);
      return { picture, text, name };
    };
    const { picture, text, name } = await save();
    names.push(name);
    expect(!/NaN|undefined|Infinity|var\(/.test(text), 'a number is missing');
    const curves = [...picture.querySelectorAll('.curve')];
    expect(curves.length === chart.data.datasets.length, `${curves.length} curves of ${chart.data.datasets.length}`);
    curves.forEach((curve) => {
      const set = chart.data.datasets.find(({ label }) => label === curve.querySelector('title').textContent);
      expect(set, 'a curve without a name');
      const points = (curve.querySelector('path').getAttribute('d').match(/[ML]/g) || []).length;
      expect(set.showLine === false || points >= set.data.length, `${points} of ${set.data.length} points of ${set.label}`);
    });
    const texts = [...picture.querySelectorAll('text')].map((one) => one.textContent);
    ['x', 'y'].forEach((axis) => {
      expect(texts.includes(chart.scales[axis].options.title.text), `no name of ${axis}`);
      const labels = chart.scales[axis].ticks.map(({ label }) => label).filter((label) => label !== '');
      expect(labels.some((label) => texts.includes(label)), `no numbers on ${axis}`);
    });
    expect(texts[0].toLowerCase() === plots.titleOf(chart).toLowerCase(), 'no title');
    expect(text.includes('<rect width="100%" height="100%" fill="white"/>'), 'no paper');
    const key = figure.querySelector('.legend button:not(.save)');
    key.click();
    const less = await save();
    expect(less.picture.querySelectorAll('.curve').length === curves.length - 1, 'a hidden curve is saved');
    key.click();
    expect(canvas.toDataURL() === before, 'saving changes the plot');
  }
  const pictures = [];
  for (const canvas of document.querySelectorAll('.shape canvas')) {
    const n = files.length;
    canvas.parentNode.querySelector('.save').click();
    for (let k = 0; k < 500 && files.length === n; k += 1) await wait(20);
    const { blob, name } = files.at(-1);
    pictures.push({ name, type: blob.type, size: blob.size });
  }
  report({ faults, failed, names, pictures, printing: document.documentElement.className });
});
</script>)";

TEST_F(Page, SavesEveryPlotAsSvgAndEveryBodyAsPng) {
  const nlohmann::json seen = seen_in(with_witness(report(), saving), 800);
  ASSERT_TRUE(seen.is_object()) << "the page did not get to its end";
  EXPECT_EQ(seen["faults"], nlohmann::json::array());
  EXPECT_EQ(seen["failed"], nlohmann::json::array());
  EXPECT_EQ(seen["printing"], "");
  EXPECT_EQ(seen["names"],
            nlohmann::json({"swinging-cube-tip-z-over-time.svg",
                            "swinging-cube-swept-share-over-time.svg",
                            "swinging-cube-kinetic-energy-over-time.svg",
                            "swinging-cube-error-of-velocity-against-seconds.svg",
                            "swinging-cube-error-of-velocity-against-spacing.svg",
                            "swinging-cube-strain-energy-against-spacing.svg",
                            "swinging-cube-energies-over-time-sph.svg",
                            "swinging-cube-energies-over-time-finite-volume.svg",
                            "swinging-cube-relative-energy-residual-over-time.svg"}));
  ASSERT_EQ(seen["pictures"].size(), 3u);
  EXPECT_EQ(seen["pictures"][0]["name"], "swinging-cube-sph-speed-t-0-002-s.png");
  for (const auto& picture : seen["pictures"]) {
    EXPECT_EQ(picture["type"], "image/png");
    EXPECT_GT(picture["size"].get<int>(), 2000);
  }
}

TEST_F(Page, SavesThePlotsOfAPageOfCurves) {
  const nlohmann::json seen = seen_in(with_witness(curves(), saving), 390);
  ASSERT_TRUE(seen.is_object()) << "the page did not get to its end";
  EXPECT_EQ(seen["faults"], nlohmann::json::array());
  EXPECT_EQ(seen["failed"], nlohmann::json::array());
  EXPECT_EQ(seen["names"], nlohmann::json({"work-error.svg"}));
}

}  // namespace
}  // namespace diptych::report
