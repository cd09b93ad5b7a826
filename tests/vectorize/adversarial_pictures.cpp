#include "adversarial_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace quadrille::test {
namespace {

constexpr double kPi = std::numbers::pi;

// The standard's distributions may differ between libraries, its generators may not. Nor is the
// order in which a call's arguments are evaluated fixed: at most one of them may draw a number.
double unit(std::mt19937& random) { return static_cast<double>(random()) / 4294967296.0; }
double between(std::mt19937& random, double low, double high) {
  return low + (high - low) * unit(random);
}
int below(std::mt19937& random, int count) { return static_cast<int>(random() % count); }
bool one_in(std::mt19937& random, int count) { return below(random, count) == 0; }

using Color = std::array<float, 4>;

Color random_color(std::mt19937& random) {
  Color color{0, 0, 0, 1};
  for (int c = 0; c < 3; ++c) color[c] = static_cast<float>(below(random, 256)) / 255;
  return color;
}

Color blend(const Color& a, const Color& b, double t) {
  Color result;
  for (int c = 0; c < 4; ++c) result[c] = static_cast<float>(a[c] + t * (b[c] - a[c]));
  return result;
}

/// A picture from a function of the pixel's centre that gives its colour.
template <class ColorAt>
Raster painted(int w, int h, const ColorAt& color_at, int channels = 3) {
  Raster picture(w, h, channels);
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const Color color = color_at(x + 0.5, y + 0.5);
      std::copy_n(color.begin(), channels, picture.pixel(x, y));
    }
  }
  return picture;
}

/// A picture of two random colours (often black and white) by a function from 0 to 1.
template <class Share>
Raster two_colored(std::mt19937& random, int w, int h, const Share& share) {
  const bool stark = one_in(random, 2);
  const Color first = stark ? Color{0, 0, 0, 1} : random_color(random);
  const Color second = stark ? Color{1, 1, 1, 1} : random_color(random);
  return painted(w, h, [&](double x, double y) { return blend(first, second, share(x, y)); });
}

/// A picture drawn by OpenCV, antialiased or not.
template <class Draw>
Raster drawn(std::mt19937& random, int w, int h, const Draw& draw) {
  const auto color = [&] {
    return cv::Scalar{below(random, 256) + 0.0, below(random, 256) + 0.0, below(random, 256) + 0.0};
  };
  cv::Mat canvas(h, w, CV_8UC3, color());
  draw(canvas, color, one_in(random, 2) ? cv::LINE_AA : cv::LINE_8);
  Raster picture(w, h, 3);
  cv::Mat target(h, w, CV_32FC3, picture.data.data());
  canvas.convertTo(target, CV_32F, 1 / 255.0);
  return picture;
}

cv::Point random_point(std::mt19937& random, int w, int h) {
  return {below(random, w), below(random, h)};
}

Raster noise(std::mt19937& random, int w, int h) {
  const bool gray = one_in(random, 2);
  return painted(w, h, [&](double, double) {
    Color color = random_color(random);
    if (gray) color[1] = color[2] = color[0];
    return color;
  });
}

Raster checkerboard(std::mt19937& random, int w, int h) {
  const int size = 1 + below(random, 8);
  return two_colored(random, w, h, [&](double x, double y) {
    return (static_cast<int>(x) / size + static_cast<int>(y) / size) & 1;
  });
}

Raster stripes(std::mt19937& random, int w, int h) {
  const double width = between(random, 1, 3), angle = between(random, 0, kPi);
  const bool smooth = one_in(random, 2);
  return two_colored(random, w, h, [&](double x, double y) {
    const double phase = (x * std::cos(angle) + y * std::sin(angle)) / width;
    return smooth ? 0.5 + 0.5 * std::sin(kPi * phase)
                  : static_cast<double>(static_cast<long long>(std::floor(phase)) & 1);
  });
}

/// Waves of the distance from a point plus turns of the angle around it: rings without turns, a
/// spiral with few, a fan with turns alone.
Raster waves(std::mt19937& random, int w, int h, double per_pixel, int turns) {
  const double cx = between(random, 0, w), cy = between(random, 0, h);
  const bool smooth = one_in(random, 2);
  return two_colored(random, w, h, [&](double x, double y) {
    const double wave = std::sin(2 * kPi * per_pixel * std::hypot(x - cx, y - cy) +
                                 turns * std::atan2(y - cy, x - cx));
    return smooth ? 0.5 + 0.5 * wave : static_cast<double>(wave > 0);
  });
}

Raster rings(std::mt19937& random, int w, int h) {
  return waves(random, w, h, 1 / between(random, 2, 24), 0);
}

Raster spiral(std::mt19937& random, int w, int h) {
  const double width = between(random, 3, 30);
  return waves(random, w, h, 1 / width, 1 + below(random, 5));
}

Raster fan(std::mt19937& random, int w, int h) {
  return waves(random, w, h, 0, 2 + below(random, 40));
}

Raster text(std::mt19937& random, int w, int h) {
  return drawn(random, w, h, [&](cv::Mat& canvas, const auto& color, int line) {
    for (int words = 1 + below(random, 12); words > 0; --words) {
      std::string word(1 + below(random, 6), ' ');
      for (char& letter : word) letter = static_cast<char>('!' + below(random, 94));
      const cv::Point start = random_point(random, w, h);
      const int font = below(random, 8), thickness = 1 + below(random, 3);
      const double size = between(random, 0.3, 2);
      cv::putText(canvas, word, start, font, size, color(), thickness, line);
    }
  });
}

Raster lines(std::mt19937& random, int w, int h) {
  return drawn(random, w, h, [&](cv::Mat& canvas, const auto& color, int line) {
    for (int count = 1 + below(random, 30); count > 0; --count) {
      const cv::Point start = random_point(random, w, h), end = random_point(random, w, h);
      const int thickness = 1 + below(random, 3);
      cv::line(canvas, start, end, color(), thickness, line);
    }
  });
}

Raster shapes(std::mt19937& random, int w, int h) {
  return drawn(random, w, h, [&](cv::Mat& canvas, const auto& color, int line) {
    for (int count = 1 + below(random, 10); count > 0; --count) {
      if (one_in(random, 2)) {
        const cv::Point center = random_point(random, w, h);
        const cv::Point axes = random_point(random, w, h);
        const double angle = between(random, 0, 180);
        cv::ellipse(canvas, center, {axes.x + 1, axes.y + 1}, angle, 0, 360, color(), cv::FILLED,
                    line);
      } else {
        std::vector<cv::Point> corners(3 + below(random, 5));
        for (cv::Point& corner : corners) corner = random_point(random, w, h);
        cv::fillPoly(canvas, std::vector{corners}, color(), line);
      }
    }
  });
}

Raster single_pixels(std::mt19937& random, int w, int h) {
  const Color ground = random_color(random);
  Raster picture = painted(w, h, [&](double, double) { return ground; });
  for (int count = 1 + below(random, 6); count > 0; --count) {
    const Color color = random_color(random);
    const cv::Point place = random_point(random, w, h);
    std::copy_n(color.begin(), 3, picture.pixel(place.x, place.y));
  }
  return picture;
}

Raster salt_and_pepper(std::mt19937& random, int w, int h) {
  const int rarity = 2 + below(random, 200);
  const Color ground = random_color(random);
  return painted(w, h, [&](double, double) {
    if (!one_in(random, rarity)) return ground;
    return one_in(random, 2) ? Color{0, 0, 0, 1} : Color{1, 1, 1, 1};
  });
}

Raster gradient(std::mt19937& random, int w, int h) {
  const double angle = between(random, 0, 2 * kPi), power = between(random, 0.3, 4);
  const int steps = one_in(random, 2) ? 2 + below(random, 30) : 0;  // banding
  const double reach = std::hypot(w, h);
  return two_colored(random, w, h, [&](double x, double y) {
    const double along =
        0.5 + (std::cos(angle) * (x - w / 2.0) + std::sin(angle) * (y - h / 2.0)) / reach;
    const double t = std::pow(std::clamp(along, 0.0, 1.0), power);
    return steps ? std::floor(t * steps) / steps : t;
  });
}

Raster constant(std::mt19937& random, int w, int h) {
  Color color = random_color(random);
  const int channels = one_in(random, 2) ? 4 : 3;
  color[3] = static_cast<float>(below(random, 3)) / 2;
  return painted(
      w, h, [&](double, double) { return color; }, channels);
}

/// Noise far below a step of 8 bits, sometimes with one stark pixel.
Raster near_constant(std::mt19937& random, int w, int h) {
  const double amplitude = std::pow(10, between(random, -7, -2));
  Raster picture = painted(w, h, [&](double, double) {
    const float v = static_cast<float>(0.5 + amplitude * (unit(random) - 0.5));
    return Color{v, v, v, 1};
  });
  if (one_in(random, 3)) {
    const cv::Point place = random_point(random, w, h);
    std::fill_n(picture.pixel(place.x, place.y), 3, 1.0f);
  }
  return picture;
}

Raster alpha_noise(std::mt19937& random, int w, int h) {
  const bool binary = one_in(random, 2);
  return painted(
      w, h,
      [&](double, double) {
        Color color = random_color(random);
        color[3] = static_cast<float>(binary ? below(random, 2) : unit(random));
        return color;
      },
      4);
}

/// A blob with holes on a transparent ground whose hidden colours vary.
Raster silhouette(std::mt19937& random, int w, int h) {
  const double petals = 1 + below(random, 9), depth = between(random, 0, 0.9);
  const double hole = between(random, 0, 0.6), softness = between(random, 0.1, 3);
  const double radius = between(random, 0.2, 0.6) * std::min(w, h);
  const Color inside = random_color(random), outside = random_color(random);
  return painted(
      w, h,
      [&](double x, double y) {
        const std::complex<double> p(x - w / 2.0, y - h / 2.0);
        const double outline = radius * (1 + depth * std::sin(petals * std::arg(p)));
        const double distance = std::max(std::abs(p) - outline, hole * radius - std::abs(p));
        Color color = distance < 0 ? inside : outside;
        color[3] = static_cast<float>(1 / (1 + std::exp(distance / softness)));
        return color;
      },
      4);
}

/// Edges that run along the frame at a distance of a few pixels, or end in its corners.
Raster frame(std::mt19937& random, int w, int h) {
  const double inset = between(random, 0, 6);
  const bool diagonal = one_in(random, 3);
  return two_colored(random, w, h, [&](double x, double y) {
    if (diagonal) return static_cast<double>(x * h > y * w);
    return static_cast<double>(std::min({x, y, w - x, h - y}) > inset);
  });
}

/// One side of one or two pixels, or of a few.
Raster sliver(std::mt19937& random, int w, int h) {
  const int thin = one_in(random, 4) ? 3 + below(random, 10) : 1 + below(random, 2);
  const int length = std::max(w, h) * (1 + below(random, 4));
  const auto draw = std::array{noise, stripes, gradient, checkerboard}[below(random, 4)];
  return one_in(random, 2) ? draw(random, thin, length) : draw(random, length, thin);
}

/// The quarters of four other pictures side by side.
Raster collage(std::mt19937& random, int w, int h) {
  Raster result(w, h, 3);
  for (int part = 0; part < 4; ++part) {
    const auto draw =
        std::array{noise, stripes, rings, text, constant, gradient, shapes}[below(random, 7)];
    const Raster source = draw(random, w, h);
    for (int y = (part & 1) ? h / 2 : 0; y < ((part & 1) ? h : h / 2); ++y) {
      for (int x = (part & 2) ? w / 2 : 0; x < ((part & 2) ? w : w / 2); ++x) {
        std::copy_n(source.pixel(x, y), 3, result.pixel(x, y));
      }
    }
  }
  return result;
}

}  // namespace

std::span<const PictureFamily> adversarial_families() {
  static const std::vector<PictureFamily> families = {
      {"Noise", noise},
      {"Checkerboard", checkerboard},
      {"Stripes", stripes},
      {"Rings", rings},
      {"Spiral", spiral},
      {"Fan", fan},
      {"Text", text},
      {"Lines", lines},
      {"Shapes", shapes},
      {"SinglePixels", single_pixels},
      {"SaltAndPepper", salt_and_pepper},
      {"Gradient", gradient},
      {"Constant", constant},
      {"NearConstant", near_constant},
      {"AlphaNoise", alpha_noise},
      {"Silhouette", silhouette},
      {"Frame", frame},
      {"Sliver", sliver},
      {"Collage", collage},
      {"Any",
       [](std::mt19937& random, int w, int h) {
         const auto all = adversarial_families();
         return all[below(random, static_cast<int>(all.size()) - 1)].draw(random, w, h);
       }},
  };
  return families;
}

int log_uniform(std::mt19937& random, int low, int high) {
  return static_cast<int>(std::lround(std::exp(between(random, std::log(low), std::log(high)))));
}

}  // namespace quadrille::test
