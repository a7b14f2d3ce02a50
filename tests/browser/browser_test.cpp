/// The page in a browser: no error on the console, every canvas drawn, hovering tells values, no
/// wider than a phone. Built where Chromium was found.

#include "tests/report/browser.hpp"

#include "postprocess/report/curve_page.hpp"
#include "postprocess/report/study_report.hpp"
#include "tests/report/sample_study.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace diptych::report {
namespace {

using test::seen_in;
using test::with_witness;

/// Moves the pointer over every canvas and writes down what happens.
const char* const looking = R"(<script>
const pixels = (canvas) => {
  const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  return new Set(new Uint32Array(data.buffer)).size;
};
addEventListener('load', async () => {
  await wait(300);
  const seen = { colours: {}, tips: {}, readings: {} };
  for (const canvas of document.querySelectorAll('canvas')) {
    seen.colours[canvas.id] = pixels(canvas);
    canvas.scrollIntoView();
    if (canvas.dataset.shape) {
      over(canvas, PointerEvent, 'pointermove', { x: canvas.clientWidth / 2, y: canvas.clientHeight / 2 });
      seen.readings[canvas.id] = document.querySelector(`.reading[data-shape="${canvas.dataset.shape}"]`).textContent;
    } else if (window.Chart) {
      const chart = Chart.getChart(canvas);
      over(canvas, MouseEvent, 'mousemove', chart.getDatasetMeta(0).data[1]);
      await painted();
      const tip = chart.tooltip;
      seen.tips[canvas.id] = tip.opacity > 0 ? tip.body.flatMap((part) => part.lines).join('; ') : '';
    }
  }
  const solid = document.querySelector('canvas[data-shape]');
  const straight = solid.toDataURL();
  over(solid, PointerEvent, 'pointerdown', { x: 50, y: 50 });
  over(solid, PointerEvent, 'pointermove', { x: 90, y: 60 });
  over(solid, PointerEvent, 'pointerup', { x: 90, y: 60 });
  await painted();
  seen.turned = solid.toDataURL() !== straight;
  const before = document.getElementById('shape-time').textContent;
  const slider = document.getElementById('shape-frame');
  slider.value = 0;
  slider.dispatchEvent(new Event('input'));
  await painted();
  Object.assign(seen, { before, after: document.getElementById('shape-time').textContent, faults,
    width: document.documentElement.clientWidth, needed: document.documentElement.scrollWidth });
  report(seen);
});
</script>)";

TEST(Browser, DrawsEveryCanvasAndTellsValuesWithoutAnError) {
  if (!std::filesystem::exists(chart_script_path())) {
    GTEST_SKIP() << "no Chart.js here: apt-get install libjs-chart.js";
  }
  const std::string page = report_html(test::full_study(), chart_script(chart_script_path()));
  const nlohmann::json seen = seen_in(with_witness(page, looking), 390);
  ASSERT_TRUE(seen.is_object()) << "the page did not get to its end";
  EXPECT_EQ(seen["faults"], nlohmann::json::array());
  EXPECT_EQ(seen["colours"].size(),
            12u);  // 3 shapes, kinetic energy, 2 probes, cost, 2 convergence, 2 + 1 energy
  for (const auto& [id, colours] : seen["colours"].items())
    EXPECT_GT(colours.get<int>(), 5) << id << " is blank";
  EXPECT_EQ(seen["readings"].size(), 3u);
  for (const auto& [id, reading] : seen["readings"].items())
    EXPECT_NE(reading.get<std::string>().find("Finite volume"), std::string::npos) << id;
  EXPECT_EQ(seen["tips"].size(), 9u);
  for (const auto& [id, tip] : seen["tips"].items())
    EXPECT_NE(tip.get<std::string>(), "") << id << " tells nothing";
  EXPECT_NE(seen["tips"]["probe-0"].get<std::string>().find(" m"), std::string::npos);
  EXPECT_NE(seen["tips"]["energy-sph"].get<std::string>().find(" J"), std::string::npos);
  EXPECT_TRUE(seen["turned"].get<bool>()) << "dragging does not turn the body";
  EXPECT_NE(seen["before"], seen["after"]) << "the slider moves nothing";
  EXPECT_LE(seen["needed"].get<int>(), seen["width"].get<int>()) << "scrolls sideways";
}

TEST(Browser, WouldShowAnError) {
  const std::string broken = report_html(test::full_study(), "/* Chart.js v3. without Chart */");
  const nlohmann::json seen = seen_in(with_witness(broken, looking), 390);
  ASSERT_TRUE(seen.is_object());
  EXPECT_NE(seen["faults"].dump().find("Chart is not defined"), std::string::npos);
}

/// Zooms every chart in each way and goes back, hides a series and shows it; notes what did not
/// work.
const char* const zooming = R"(<script>
const ranges = ({ scales: { x, y } }) => [x.min, x.max, y.min, y.max];
const same = (a, b) => a.every((value, i) => Math.abs(value - b[i]) <= 1e-9 * Math.abs(b[i] - b[i ^ 1]));
const within = ([a, b, c, d], [A, B, C, D]) => a >= A && b <= B && c >= C && d <= D && (b - a < 0.9 * (B - A)) && (d - c < 0.9 * (D - C));
addEventListener('load', async () => {
  await wait(300);
  const failed = [], zoomed = [];
  for (const canvas of document.querySelectorAll('.plot canvas')) {
    const chart = () => Chart.getChart(canvas);
    const expect = (condition, what) => { if (!condition) failed.push(`${canvas.id}: ${what}`); };
    const { left, right, top, bottom } = chart().chartArea;
    const at = (s, t) => ({ x: left + s * (right - left), y: top + t * (bottom - top) });
    const mouse = { pointerId: 1, pointerType: 'mouse', button: 0 };
    const all = ranges(chart());
    const button = canvas.parentNode.querySelector('.whole');
    const goesBack = (how) => expect(same(ranges(chart()), all) && button.hidden, `${how} does not show all`);
    const drag = (from, to) => {
      over(canvas, PointerEvent, 'pointerdown', from, mouse);
      over(canvas, PointerEvent, 'pointermove', to, mouse);
      over(canvas, PointerEvent, 'pointerup', to, mouse);
    };
    drag(at(0.3, 0.3), at(0.6, 0.7));
    expect(within(ranges(chart()), all) && !button.hidden, 'dragging does not zoom');
    for (const scale of Object.values(chart().scales)) {
      expect(scale.ticks.filter(({ label }) => label !== '').length > 1, `no labels on ${scale.axis} when zoomed`);
    }
    over(canvas, MouseEvent, 'dblclick', at(0.5, 0.5));
    goesBack('double click');
    drag(at(0.3, 0.5), at(0.6, 0.51));
    expect(ranges(chart())[1] < all[1] && same(ranges(chart()).slice(2), all.slice(2)), 'a flat drag does not keep y');
    button.click();
    goesBack('the button');
    const key = (name) => canvas.dispatchEvent(new KeyboardEvent('keydown', { key: name, cancelable: true }));
    expect(canvas.tabIndex === 0, 'no place for the keyboard');
    expect(key('ArrowRight'), 'an arrow does not scroll the page');
    key('+');
    const larger = ranges(chart());
    expect(within(larger, all), '+ does not zoom');
    key('ArrowRight');
    expect(ranges(chart())[0] > larger[0] && same(ranges(chart()).slice(2), larger.slice(2)), 'ArrowRight does not move');
    key('0');
    goesBack('0');
    expect(!over(canvas, WheelEvent, 'wheel', at(0.5, 0.5), { deltaY: -100 }).defaultPrevented, 'the page does not scroll');
    const wheel = over(canvas, WheelEvent, 'wheel', at(0.5, 0.5), { deltaY: -100, ctrlKey: true });
    expect(wheel.defaultPrevented && within(ranges(chart()), all), 'the wheel does not zoom');
    over(canvas, WheelEvent, 'wheel', at(0.5, 0.5), { deltaY: 100, ctrlKey: true });
    goesBack('the wheel');
    const finger = (pointerId) => ({ pointerId, pointerType: 'touch' });
    over(canvas, PointerEvent, 'pointerdown', at(0.45, 0.5), finger(2));
    over(canvas, PointerEvent, 'pointerdown', at(0.55, 0.5), finger(3));
    over(canvas, PointerEvent, 'pointermove', at(0.3, 0.5), finger(2));
    over(canvas, PointerEvent, 'pointermove', at(0.7, 0.5), finger(3));
    expect(within(ranges(chart()), all), 'two fingers do not zoom');
    [2, 3].forEach((id) => over(canvas, PointerEvent, 'pointerup', at(0.5, 0.5), finger(id)));
    key('Escape');
    goesBack('Escape');
    const [first] = canvas.closest('figure').querySelectorAll('.legend button');
    first.click();
    expect(!chart().isDatasetVisible(0) && first.getAttribute('aria-pressed') === 'false', 'the legend hides nothing');
    first.click();
    expect(chart().isDatasetVisible(0) && first.getAttribute('aria-pressed') === 'true', 'the legend shows nothing');
    zoomed.push(canvas.id);
  }
  report({ faults, failed, zoomed });
});
</script>)";

void expect_zooms(const std::string& page, size_t n_plots) {
  const nlohmann::json seen = seen_in(with_witness(page, zooming), 390);
  ASSERT_TRUE(seen.is_object()) << "the page did not get to its end";
  EXPECT_EQ(seen["faults"], nlohmann::json::array());
  EXPECT_EQ(seen["failed"], nlohmann::json::array());
  EXPECT_EQ(seen["zoomed"].size(), n_plots);
}

TEST(Browser, ZoomsEveryPlotAndHidesItsSeries) {
  if (!std::filesystem::exists(chart_script_path())) {
    GTEST_SKIP() << "no Chart.js here: apt-get install libjs-chart.js";
  }
  const std::string script = chart_script(chart_script_path());
  expect_zooms(report_html(test::full_study(), script),
               9);  // kinetic, 2 probes, 3 errors, 3 energy
  const Curve a{"SPH", {0.1, 1, 10}, {1e-2, 1e-3, 1e-4}}, b{"FVM", {0.2, 2, 0}, {1e-2, 1e-3, 1}};
  expect_zooms(curve_page("Work", "", "", {{"p", "s", "e", {a, b}, true}}, "table", script), 1);
  // a parameter over decades, another on a linear axis; quantities of both signs
  const Curve wide{"SPH 0", {0.01, 1, 100}, {-2, 0.5, 3}}, narrow{"FVM 0", {1, 2, 3}, {-1, 0, 1}};
  expect_zooms(curve_page("Q", "", "", {{"p", "De", "u", {wide}}, {"q", "nu", "u", {narrow}}},
                          "table", script),
               2);
}

}  // namespace
}  // namespace diptych::report
