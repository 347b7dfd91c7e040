#include "reports/picture/svg_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace nearmiss {

namespace {

/// Tenths of a pixel. Round numbers of a case are often ties; half a millionth of a tenth more, and an error of the
/// last bit does not decide to which side a tie goes.
std::string tenths(double x) {
  const double n = std::floor(x * 10 + 0.5 + 0.5e-6) / 10;
  return fmt::format("{}", n + 0.0);
}
/// SVG counts downward.
std::string svg_point(const FlatPoint& p) { return tenths(p.right) + " " + tenths(-p.up); }

std::string svg_escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) safe += c == '<' ? "&lt;" : c == '&' ? "&amp;" : c == '>' ? "&gt;" : std::string(1, c);
  return safe;
}

/// The class of the style.
char letter_of(Ink ink) {
  switch (ink) {
    case Ink::first_shape: return 'a';
    case Ink::other_shape: return 'b';
    case Ink::way: return 'w';
    case Ink::exact: return 'e';
    case Ink::given: return 'g';
    case Ink::frame: break;
  }
  return 'f';
}

constexpr std::string_view style =
    "<style>*{fill:none;stroke-linejoin:round}text{font:12px sans-serif;fill:#222;stroke:none}"
    ".a{fill:#4878b0;fill-opacity:.25;stroke:#35608f}.b{fill:#c98a1b;fill-opacity:.25;stroke:#8f6114}"
    ".w{stroke:#555;stroke-dasharray:1 3}.f{stroke:#888}"
    ".e{stroke:#0a7d32;stroke-width:5;stroke-opacity:.6}.g{stroke:#d0112b;stroke-width:1.7;stroke-dasharray:5 3}"
    ".o{stroke-width:1.7;stroke-opacity:1}.h{stroke-dasharray:none}.d{fill:#0a7d32;stroke:#fff}</style>";

std::string svg_path(std::string_view kind, std::string_view d) {
  return fmt::format("<path class=\"{}\" d=\"{}\"/>", kind, d);
}

/// A polygon rounded by a radius, counterclockwise: edges moved outward, joined by arcs.
std::string rounded_polygon(const FlatOutline& o) {
  const std::size_t n = o.corners.size();
  std::string d;
  for (std::size_t i = 0; i < n; ++i) {
    const FlatPoint &p = o.corners[i], &q = o.corners[(i + 1) % n];
    const FlatPoint along = q - p;
    const double k = o.radius > 0 ? o.radius / along.length() : 0;
    const FlatPoint out{along.up * k, -along.right * k};
    const FlatPoint from = p + out, to = q + out;
    const std::string radius = tenths(o.radius);
    d += d.empty()      ? "M" + svg_point(from)
         : o.radius > 0 ? fmt::format("A{0} {0} 0 0 0 {1}", radius, svg_point(from))
                        : "";
    if (o.radius > 0 || i + 1 < n) d += "L" + svg_point(to);
  }
  const FlatPoint along = o.corners[1] - o.corners[0];
  if (o.radius > 0) {
    const double k = o.radius / along.length();
    d += fmt::format("A{0} {0} 0 0 0 {1}", tenths(o.radius),
                     svg_point({o.corners[0].right + along.up * k, o.corners[0].up - along.right * k}));
  }
  return d + "z";
}

std::string svg_outline(const FlatOutline& o) {
  if (o.corners.empty()) return "";
  std::string kind(1, letter_of(o.ink));
  if (o.ink == Ink::exact) kind += " o";
  if (o.corners.size() == 1) {
    constexpr double dot = 2;  // pixels, of a point
    return fmt::format("<circle class=\"{}\" cx=\"{}\" cy=\"{}\" r=\"{}\"/>", kind, tenths(o.corners[0].right),
                       tenths(-o.corners[0].up), tenths(std::max(o.radius, dot)));
  }
  std::string d = rounded_polygon(o);
  for (const auto& [from, to] : o.edges) d += "M" + svg_point(from) + "L" + svg_point(to);
  return svg_path(kind, d);
}

/// Seen from its end: rings.
std::string arrow_to_the_viewer(const FlatArrow& a) {
  const int radius = a.ink == Ink::exact ? 8 : 5;
  return fmt::format("<circle class=\"{} h\" cx=\"{}\" cy=\"{}\" r=\"{}\"/>", letter_of(a.ink), tenths(a.from.right),
                     tenths(-a.from.up), radius);
}
std::string svg_arrow(const FlatArrow& a) {
  const FlatPoint way = a.to - a.from;
  const double long_as = way.length();
  constexpr double least = 3;  // pixels: less has no direction
  if (long_as < least) return a.ink == Ink::way ? "" : arrow_to_the_viewer(a);
  const double head = std::min(9.0, long_as * 0.6), k = head / long_as;
  const FlatPoint back = a.to - way * k, side{way.up * k * 0.55, -way.right * k * 0.55};
  const std::string shaft = fmt::format("M{}L{}", svg_point(a.from), svg_point(a.to));
  const std::string barbs = fmt::format("M{}L{}L{}", svg_point(back + side), svg_point(a.to), svg_point(back - side));
  const char ink = letter_of(a.ink);
  return svg_path(std::string(1, ink), shaft) + svg_path(std::string(1, ink) + " h", barbs);
}

std::string svg_mark(const FlatMark& m) {
  if (m.ink == Ink::exact)
    return fmt::format("<circle class=\"d\" cx=\"{}\" cy=\"{}\" r=\"4.5\"/>", tenths(m.at.right), tenths(-m.at.up));
  return svg_path("g h", fmt::format("M{}m-6 -6l12 12m0-12l-12 12", svg_point(m.at)));
}

/// The coordinate axes in the lower left corner; one that is nearly seen from its end is left out.
std::string axes_of_view(const FlatView& v) {
  constexpr double size = 15, least = 0.3, letter = 9;  // pixels, but for `least`
  const FlatPoint origin{28 - FlatView::width / 2, 28 - FlatView::height / 2};
  std::string text;
  std::vector<FlatPoint> letters;
  for (std::size_t k = 0; k < 3; ++k) {
    const FlatPoint& a = v.axes[k];
    if (a.length() < least) continue;
    FlatPoint name = origin + a * size + a * (letter / a.length());
    for (const FlatPoint& other : letters) {
      if ((name - other).length() < letter) name.right += letter;
    }
    letters.push_back(name);
    text += svg_path("f", fmt::format("M{}l{}", svg_point(origin), svg_point(a * size)));
    text += fmt::format("<text x=\"{}\" y=\"{}\">{}</text>", tenths(name.right - 3), tenths(4 - name.up), "xyz"[k]);
  }
  return text;
}
/// 1, 2 or 5 times a power of ten, nearest below a third of the view.
std::string scale_bar(const FlatView& v) {
  const double most = FlatView::width / 3 / v.pixels_per_unit;
  const double power = std::pow(10, std::floor(std::log10(most)));
  const double unit = 5 * power <= most ? 5 * power : 2 * power <= most ? 2 * power : power;
  const double right = FlatView::width / 2 - 8, down = FlatView::height / 2 - 8, bar = unit * v.pixels_per_unit;
  return svg_path("f", fmt::format("M{} {}v4h{}v-4", tenths(right - bar), tenths(down - 4), tenths(bar))) +
         fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{:.4g}</text>", tenths(right), tenths(down - 7),
                     unit);
}

std::string svg_view(const FlatView& v, std::size_t index) {
  std::string text = fmt::format("<svg x=\"{}\" width=\"{}\" height=\"{}\" viewBox=\"{} {} {} {}\">",
                                 index * std::size_t(FlatView::width), FlatView::width, FlatView::height,
                                 -FlatView::width / 2, -FlatView::height / 2, FlatView::width, FlatView::height);
  for (const FlatOutline& o : v.outlines) text += svg_outline(o);
  for (const FlatArrow& a : v.arrows) text += svg_arrow(a);
  for (const FlatMark& m : v.marks) text += svg_mark(m);
  text += svg_path("f", fmt::format("M{0} {1}h{2}v{3}h-{2}z", -FlatView::width / 2, -FlatView::height / 2,
                                    FlatView::width, FlatView::height));
  if (v.enlarged != 1)
    text += fmt::format("<text x=\"{}\" y=\"{}\">× {:.{}f}</text>", 8 - FlatView::width / 2, 16 - FlatView::height / 2,
                        v.enlarged, v.enlarged < 10 ? 1 : 0);
  return text + axes_of_view(v) + scale_bar(v) + "</svg>\n";
}

/// The sign of an entry: what it looks like in the views.
std::string sign(Ink ink, double x, double y) {
  const FlatPoint at{x + 5, -(y - 4)};
  switch (ink) {
    case Ink::exact:
    case Ink::given: return svg_mark({ink, at});
    case Ink::way: return svg_arrow({ink, {x - 2, at.up}, {x + 12, at.up}});
    case Ink::frame: return "";
    default: return svg_outline({ink, {{x, -y}, {x + 10, -y}, {x + 10, 10 - y}, {x, 10 - y}}});
  }
}

/// About the width of a text of 12 pixels in UTF-8.
double width_of(std::string_view text) {
  return 6.2 * double(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string entry(const FlatLegend& l, double x, double y) {
  const double after = l.ink == Ink::frame ? 0 : 17;
  return sign(l.ink, x, y) +
         fmt::format("<text x=\"{}\" y=\"{}\">{}</text>", tenths(x + after), tenths(y), svg_escaped(l.text));
}

/// The words of a text in lines of a width.
std::vector<std::string> lines_of(std::string_view text, double width) {
  std::vector<std::string> lines{""};
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string word(text.substr(at, end - at));
    if (!lines.back().empty() && width_of(lines.back() + " " + word) > width) lines.emplace_back();
    lines.back() += (lines.back().empty() ? "" : " ") + word;
    at = end + 1;
  }
  return lines;
}

}  // namespace

std::string svg_picture(const FlatPicture& picture) {
  if (picture.views.empty()) return "";
  constexpr double row = 18;
  const double width = FlatView::width * double(picture.views.size());
  std::string body;
  double x = 8, y = FlatView::height + row;
  for (const FlatLegend& l : picture.legend) {
    if (l.ink != Ink::exact && l.ink != Ink::given) {
      if (x + width_of(l.text) + 25 > width) x = 8, y += row;
      body += entry(l, x, y);
      x += width_of(l.text) + 34;
      continue;
    }
    Ink ink = l.ink;
    for (const std::string& line : lines_of(l.text, width - 40)) {
      y += row;
      body += ink == Ink::frame ? entry({ink, line}, 25, y) : entry({ink, line}, 8, y);
      ink = Ink::frame;
    }
  }
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">", width, y + 10);
  text += std::string(style) + "\n" + "<path style=\"fill:#fff\" d=\"M0 0h" + tenths(width) + "v" + tenths(y + 10) +
          "H0z\"/>\n";
  for (std::size_t i = 0; i < picture.views.size(); ++i) text += svg_view(picture.views[i], i);
  return text + body + "</svg>\n";
}

}  // namespace nearmiss
