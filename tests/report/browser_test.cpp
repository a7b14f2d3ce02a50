/// The page in a browser: no error on the console, every canvas drawn, hovering tells values, no
/// wider than a phone. Needs headless Chromium; skipped where there is none.

#include "common/io/run_record.hpp"
#include "postprocess/report/html.hpp"
#include "postprocess/report/study_report.hpp"
#include "tests/common/io/scratch.hpp"
#include "tests/report/decoded.hpp"
#include "tests/report/sample_study.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace diptych::report {
namespace {

/// Ahead of the page's own scripts: collects what a console would show, and gives frames by the
/// clock, which a browser that runs ahead of time does not.
const char* const listening = R"(<script>
const faults = [];
Element.prototype.setPointerCapture = () => {};  // refuses pointers that no hand moves
window.requestAnimationFrame = (paint) => setTimeout(() => paint(performance.now()), 16);
addEventListener('error', (event) => faults.push(event.message));
addEventListener('unhandledrejection', (event) => faults.push(String(event.reason)));
addEventListener('securitypolicyviolation', (event) => faults.push(event.violatedDirective));
['error', 'warn'].forEach((kind) => { console[kind] = (...all) => faults.push(all.join(' ')); });
</script>)";

/// After them: moves the pointer over every canvas and writes down what happens.
const char* const looking = R"(<script>
const wait = (ms) => new Promise((done) => { setTimeout(done, ms); });
const painted = () => new Promise((done) => { requestAnimationFrame(() => requestAnimationFrame(done)); });
const over = (canvas, kind, type, { x, y }) => {
  const box = canvas.getBoundingClientRect();
  canvas.dispatchEvent(new kind(type, { bubbles: true, clientX: box.left + x, clientY: box.top + y }));
};
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
  const note = document.createElement('pre');
  note.textContent = `SEEN${btoa(unescape(encodeURIComponent(JSON.stringify(seen))))}SEEN`;
  parent.document.body.append(note);
});
</script>)";

std::string chromium() {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"}) {
    if (std::system(fmt::format("command -v {} > /dev/null 2>&1", name).c_str()) == 0) return name;
  }
  return {};
}

std::string with_witness(std::string html) {
  html.insert(html.find("<title>"), listening);
  html.insert(html.rfind("</body>"), looking);
  return html;
}

/// Decodes what the page has seen of itself.
nlohmann::json seen_in(const std::string& page, int width) {
  const test::Scratch folder;
  // Chromium's own windows are 500 pixels wide or more
  io::write_file_atomically(folder / "page.html",
                            fmt::format("<meta charset=\"utf-8\"><iframe style=\"width: {}px; "
                                        "height: 900px\" srcdoc=\"{}\"></iframe>",
                                        width, escaped(page)));
  const std::string dom = folder / "dom.html";
  const std::string command = fmt::format(
      "timeout 100 {} --headless --no-sandbox --disable-gpu --user-data-dir='{}' "
      "--virtual-time-budget=20000 --dump-dom 'file://{}' > '{}' 2> /dev/null",
      chromium(), folder / "profile", folder / "page.html", dom);
  if (std::system(command.c_str()) != 0) return {};
  const std::string text = io::read_file(dom);
  const size_t from = text.find("<pre>SEEN"), to = text.find("SEEN</pre>");
  if (from == std::string::npos || to == std::string::npos) return {};
  const auto bytes = test::decoded(text.substr(from + 9, to - from - 9));
  return nlohmann::json::parse(bytes);
}

TEST(Browser, DrawsEveryCanvasAndTellsValuesWithoutAnError) {
  if (chromium().empty()) GTEST_SKIP() << "no Chromium here: apt-get install chromium";
  if (!std::filesystem::exists(chart_script_path())) {
    GTEST_SKIP() << "no Chart.js here: apt-get install libjs-chart.js";
  }
  const std::string page = report_html(test::full_study(), chart_script(chart_script_path()));
  const nlohmann::json seen = seen_in(with_witness(page), 390);
  ASSERT_TRUE(seen.is_object()) << "the page did not get to its end";
  EXPECT_EQ(seen["faults"], nlohmann::json::array());
  EXPECT_EQ(seen["colours"].size(), 11u);  // 3 shapes, 2 probes, cost, 2 convergence, 2 + 1 energy
  for (const auto& [id, colours] : seen["colours"].items())
    EXPECT_GT(colours.get<int>(), 5) << id << " is blank";
  EXPECT_EQ(seen["readings"].size(), 3u);
  for (const auto& [id, reading] : seen["readings"].items())
    EXPECT_NE(reading.get<std::string>().find("Finite volume"), std::string::npos) << id;
  EXPECT_EQ(seen["tips"].size(), 8u);
  for (const auto& [id, tip] : seen["tips"].items())
    EXPECT_NE(tip.get<std::string>(), "") << id << " tells nothing";
  EXPECT_NE(seen["tips"]["probe-0"].get<std::string>().find(" m"), std::string::npos);
  EXPECT_NE(seen["tips"]["energy-sph"].get<std::string>().find(" J"), std::string::npos);
  EXPECT_TRUE(seen["turned"].get<bool>()) << "dragging does not turn the body";
  EXPECT_NE(seen["before"], seen["after"]) << "the slider moves nothing";
  EXPECT_LE(seen["needed"].get<int>(), seen["width"].get<int>()) << "scrolls sideways";
}

TEST(Browser, WouldShowAnError) {
  if (chromium().empty()) GTEST_SKIP() << "no Chromium here: apt-get install chromium";
  const std::string broken = report_html(test::full_study(), "/* Chart.js v3. without Chart */");
  const nlohmann::json seen = seen_in(with_witness(broken), 390);
  ASSERT_TRUE(seen.is_object());
  EXPECT_NE(seen["faults"].dump().find("Chart is not defined"), std::string::npos);
}

}  // namespace
}  // namespace diptych::report
