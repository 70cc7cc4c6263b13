// CSS of page.h, and the script that sorts its tables.
#pragma once

#include <string_view>

namespace rend::html {

// One set of custom properties for colours; dark mode changes only their values. Badges also differ by their
// words.
inline constexpr std::string_view page_style = R"(
:root { --text:#1c2126; --soft:#5b6670; --line:#dde2e7; --back:#ffffff; --panel:#f5f7f9; --link:#0b5cad;
  --good:#1a7f37; --good-back:#dff3e4; --note:#0b5cad; --note-back:#e0edfa;
  --limit:#8a5300; --limit-back:#fdf0d5;
  --bad:#b3201f; --bad-back:#fde3e1; --plain:#4a545d; --plain-back:#e8ecef; }
@media (prefers-color-scheme: dark) { :root { --text:#e3e7ea; --soft:#9aa5af; --line:#343c44; --back:#14181c;
  --panel:#1c2228; --link:#7ab8f5; --good:#7fdc9a; --good-back:#17361f; --note:#8cc3f8; --note-back:#152f4a;
  --limit:#f2c572; --limit-back:#3d2d0d; --bad:#ff9a94; --bad-back:#4a1a18; --plain:#b9c2ca;
  --plain-back:#2a3138; } }
* { box-sizing:border-box; }
body { margin:0; background:var(--back); color:var(--text);
  font:15px/1.5 system-ui, -apple-system, "Segoe UI", "DejaVu Sans", Arial, sans-serif; }
main { max-width:1180px; margin:0 auto; padding:28px 24px 64px; }
h1 { font-size:30px; line-height:1.2; margin:0 0 12px; letter-spacing:-0.3px; }
h2 { font-size:21px; margin:40px 0 10px; padding-top:14px; border-top:1px solid var(--line); }
h3 { font-size:17px; margin:26px 0 8px; }
h4 { font-size:15px; margin:18px 0 6px; }
p, ul { margin:8px 0; max-width:92ch; }
li { margin:3px 0; }
a { color:var(--link); text-decoration:none; } a:hover { text-decoration:underline; }
.muted, caption, figcaption { color:var(--soft); }
code, pre { font-family:ui-monospace, "DejaVu Sans Mono", Consolas, monospace; font-size:0.88em; }
code { background:var(--panel); border-radius:4px; padding:1px 4px; }
pre { background:var(--panel); border:1px solid var(--line); border-radius:6px; padding:10px 12px;
  overflow-x:auto; }
.wide { overflow-x:auto; margin:10px 0; }
table { border-collapse:collapse; font-size:14px; font-variant-numeric:tabular-nums; }
caption { text-align:left; padding:2px 0 6px; }
th, td { padding:5px 12px 5px 8px; border-bottom:1px solid var(--line); text-align:left; vertical-align:top; }
th { font-weight:600; color:var(--soft); border-bottom:2px solid var(--line); white-space:nowrap; }
.number { text-align:right; }
td.number { white-space:nowrap; }
tbody tr:hover { background:var(--panel); }
table.sortable th { cursor:pointer; }
th[data-sorted=up]::after { content:" \2191"; } th[data-sorted=down]::after { content:" \2193"; }
dl { display:grid; grid-template-columns:max-content 1fr; gap:4px 18px; margin:10px 0; font-size:14px; }
dt { color:var(--soft); } dd { margin:0; overflow-wrap:anywhere; }
.badge { display:inline-block; padding:0 8px; border-radius:10px; font-size:12.5px; font-weight:600;
  line-height:20px; white-space:nowrap; }
.good { color:var(--good); background:var(--good-back); }
.note { color:var(--note); background:var(--note-back); }
.limit { color:var(--limit); background:var(--limit-back); }
.bad { color:var(--bad); background:var(--bad-back); }
.plain { color:var(--plain); background:var(--plain-back); }
.tiles { display:flex; flex-wrap:wrap; gap:12px; margin:16px 0; }
.tile { min-width:132px; padding:10px 16px; border-radius:8px; }
.tile b { display:block; font-size:26px; line-height:1.25; font-weight:650; } .tile span { font-size:13.5px; }
figure { margin:14px 0; } figure img { max-width:100%; height:auto; background:#ffffff; border-radius:6px;
  border:1px solid var(--line); padding:6px; }
figcaption { font-size:14px; max-width:92ch; }
details { margin:8px 0; border:1px solid var(--line); border-radius:6px; }
summary { cursor:pointer; padding:7px 12px; font-weight:600; }
details[open] > summary { border-bottom:1px solid var(--line); }
.inner { padding:4px 14px 10px; }
@media print { main { max-width:none; padding:0; } body { font-size:11px; } table { font-size:10px; }
  h2, h3, h4 { break-after:avoid; } tr, figure, .tile { break-inside:avoid; } .wide { overflow:visible; }
  .badge, .tile { border:1px solid; } a { color:inherit; } }
)";

// A click on a column's name sorts by it: numerically where both cells are numbers, else as text; the sort is
// stable.
inline constexpr std::string_view page_script = R"(
document.querySelectorAll('table.sortable th').forEach(function (head) {
  head.addEventListener('click', function () {
    var table = head.closest('table'), body = table.tBodies[0], column = head.cellIndex;
    var down = head.getAttribute('data-sorted') === 'up';
    table.querySelectorAll('th').forEach(function (other) { other.removeAttribute('data-sorted'); });
    head.setAttribute('data-sorted', down ? 'down' : 'up');
    var key = function (row) {
      var cell = row.cells[column];
      return cell.hasAttribute('data-order') ? cell.getAttribute('data-order') : cell.textContent.trim();
    };
    var compare = function (a, b) {
      var x = key(a), y = key(b), p = Number(x), q = Number(y);
      var words = x === '' || y === '' || isNaN(p) || isNaN(q);
      return (words ? x.localeCompare(y) : p - q) * (down ? -1 : 1);
    };
    Array.from(body.rows).sort(compare).forEach(function (row) { body.appendChild(row); });
  });
});
)";

} // namespace rend::html
