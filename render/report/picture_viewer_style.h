// CSS and script of picture_viewer.h.
#pragma once

#include <string_view>

namespace rend::html {

inline constexpr std::string_view comparison_style = R"(
.compare { margin:10px 0 4px; }
.compare .bar { display:flex; flex-wrap:wrap; gap:6px 14px; align-items:center; margin:0 0 8px; }
.compare .ways { display:inline-flex; flex-wrap:wrap; border:1px solid var(--line); border-radius:7px;
  overflow:hidden; }
.compare button { font:inherit; font-size:13.5px; color:var(--text); background:var(--panel); border:0;
  padding:4px 12px; cursor:pointer; border-right:1px solid var(--line); }
.compare .ways button:last-child { border-right:0; }
.compare button[aria-pressed=true] { background:var(--link); color:var(--back); }
.compare button:focus-visible, .compare input:focus-visible { outline:2px solid var(--link);
  outline-offset:1px; }
.compare .said { color:var(--soft); font-size:13.5px; }
.stack { position:relative; display:grid; width:max-content; max-width:100%; border:1px solid var(--line);
  border-radius:4px; overflow:hidden; cursor:crosshair; isolation:isolate;
  background:repeating-conic-gradient(#bfc4c9 0 25%, #e9ecee 0 50%) 0 0 / 16px 16px; }
.stack img { grid-area:1 / 1; display:block; max-width:100%; height:auto; }
.stack.small img { width:640px; image-rendering:pixelated; }
.stack .mark { grid-area:1 / 1; position:absolute; border:2px solid #ff2fb3; box-shadow:0 0 0 1px #ffffff;
  pointer-events:none; }
.stack .edge { position:absolute; top:0; bottom:0; width:2px; margin-left:-1px; background:#ff2fb3;
  pointer-events:none; display:none; }
[data-way=slider] .edge { display:block; }
[data-way=now] .b, [data-way=expected] .a, [data-way=heat] .heat { z-index:2; }
[data-way=expected] .b, [data-way=expected] .heat, [data-way=now] .a, [data-way=now] .heat,
[data-way=slider] .heat, [data-way=blink] .heat, [data-way=difference] .heat, [data-way=heat] .a,
[data-way=heat] .b { visibility:hidden; }
[data-way=blink].off .b { visibility:hidden; }
[data-way=difference] .b { mix-blend-mode:difference; }
[data-way=difference] .stack { filter:brightness(8); background:#000000; }
[data-way=side] .stack { grid-template-columns:repeat(auto-fit, minmax(280px, 1fr)); gap:6px; width:auto;
  border:0; background:none; cursor:default; }
[data-way=side] .stack img { grid-area:auto; width:100%; max-width:640px; border:1px solid var(--line); }
[data-way=side] .mark, [data-way=side] .edge { display:none; }
.compare input[type=range] { width:100%; display:block; margin:6px 0; accent-color:#ff2fb3; }
.compare:not([data-way=slider]) input[type=range] { display:none; }
.look { display:flex; flex-wrap:wrap; gap:4px 18px; align-items:flex-start; }
.look > div:first-child { max-width:100%; }
.near { flex:1 1 300px; } .near p { margin:2px 0; font-size:13.5px; }
[data-way=side] .look > div:first-child { flex:1 1 100%; }
.zooms { display:flex; flex-wrap:wrap; gap:8px 10px; margin:0 0 6px; }
.zooms figure { margin:0; }
.zooms canvas { display:block; width:208px; height:208px; border:1px solid var(--line);
  border-radius:4px; image-rendering:pixelated; background:var(--panel); }
.zooms figcaption { font-size:13px; }
@media print { .compare .bar, .compare input[type=range] { display:none; } }
)";

// Without < and &: a page must also be well-formed XML.
inline constexpr std::string_view comparison_script = R"(
(function () {
  var part = 32;
  var every = function (list, action) { Array.prototype.forEach.call(list, action); };
  every(document.querySelectorAll('.compare[data-width]'), function (box) {
    var width = Number(box.dataset.width), height = Number(box.dataset.height);
    var stack = box.querySelector('.stack'), range = box.querySelector('input[type=range]');
    var now = box.querySelector('.b'), edge = box.querySelector('.edge'), mark = box.querySelector('.mark');
    var said = box.querySelector('.said'), timer = null;
    var slide = function () {
      var at = Number(range.value);
      now.style.clipPath = box.dataset.way === 'slider' ? 'inset(0 0 0 ' + at + '%)' : 'none';
      edge.style.left = at + '%';
    };
    var show = function (way) {
      box.dataset.way = way;
      box.classList.remove('off');
      if (timer) { clearInterval(timer); timer = null; }
      if (way === 'blink') {
        timer = setInterval(function () {
          said.textContent = box.classList.toggle('off') ? 'expected' : 'now';
        }, 600);
      }
      said.textContent = way === 'slider' ? 'left: expected, right: now'
        : way === 'side' ? 'expected, now, heat map' : way === 'difference' ? 'eight times as bright as it is'
        : way === 'blink' ? 'now' : '';
      every(box.querySelectorAll('.ways button'), function (button) {
        button.setAttribute('aria-pressed', button.dataset.way === way ? 'true' : 'false');
      });
      slide();
    };
    var zoom = function (x, y) {
      var left = Math.max(0, Math.min(width - part, x - part / 2));
      var top = Math.max(0, Math.min(height - part, y - part / 2));
      left = Math.round(left); top = Math.round(top);
      every(box.querySelectorAll('canvas'), function (canvas) {
        var picture = box.querySelector('.' + canvas.dataset.of), pen = canvas.getContext('2d');
        pen.imageSmoothingEnabled = false;
        pen.clearRect(0, 0, canvas.width, canvas.height);
        pen.drawImage(picture, left, top, part, part, 0, 0, canvas.width, canvas.height);
      });
      mark.style.left = 100 * left / width + '%';
      mark.style.top = 100 * top / height + '%';
      mark.style.width = 100 * Math.min(part, width) / width + '%';
      mark.style.height = 100 * Math.min(part, height) / height + '%';
      box.querySelector('.place').textContent = left + ', ' + top;
    };
    every(box.querySelectorAll('.ways button'), function (button) {
      button.addEventListener('click', function () { show(button.dataset.way); });
    });
    range.addEventListener('input', slide);
    stack.addEventListener('click', function (event) {
      if (box.dataset.way === 'side') return;
      var frame = stack.getBoundingClientRect();
      zoom((event.clientX - frame.left) / frame.width * width,
           (event.clientY - frame.top) / frame.height * height);
    });
    var start = function () {
      show('slider');
      var waiting = 0, ready = function () { waiting -= 1; if (waiting === 0) worst(); };
      every(box.querySelectorAll('img'), function (picture) {
        if (picture.complete) return;
        waiting += 1;
        picture.addEventListener('load', ready);
        picture.addEventListener('error', ready);
      });
      if (waiting === 0) worst();
    };
    var worst = function () { zoom(Number(box.dataset.x), Number(box.dataset.y)); };
    box.querySelector('.worst').addEventListener('click', worst);
    box.classList.add('live');
    start();
  });
})();
)";

} // namespace rend::html
