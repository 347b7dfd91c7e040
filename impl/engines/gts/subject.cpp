/// The GNU Triangulated Surface library as a plugin, in double: segments, triangles and axis-aligned boxes by its
/// predicates, and its distances of points.
#include <gts.h>

#include "nearmiss_plugin.h"

namespace {

GtsVertex* vertex(const double* in) { return gts_vertex_new(gts_vertex_class(), in[0], in[1], in[2]); }
/// Objects of a case. Those of GTS end with the last one that refers to them.
class Segment {
 public:
  explicit Segment(const double* in) : it_(gts_segment_new(gts_segment_class(), vertex(in), vertex(in + 3))) {}
  Segment(const Segment&) = delete;
  Segment& operator=(const Segment&) = delete;
  ~Segment() { gts_object_destroy(GTS_OBJECT(it_)); }
  operator GtsSegment*() const { return it_; }

 private:
  GtsSegment* it_;
};
class Triangle {
 public:
  explicit Triangle(const double* in) {
    GtsVertex* v[] = {vertex(in), vertex(in + 3), vertex(in + 6)};
    GtsEdge* e[3];
    for (int i = 0; i < 3; ++i) e[i] = gts_edge_new(gts_edge_class(), v[i], v[(i + 1) % 3]);
    it_ = gts_triangle_new(gts_triangle_class(), e[0], e[1], e[2]);
  }
  Triangle(const Triangle&) = delete;
  Triangle& operator=(const Triangle&) = delete;
  ~Triangle() { gts_object_destroy(GTS_OBJECT(it_)); }
  operator GtsTriangle*() const { return it_; }

 private:
  GtsTriangle* it_;
};
class Point {
 public:
  explicit Point(const double* in) : it_(gts_point_new(gts_point_class(), in[0], in[1], in[2])) {}
  Point(const Point&) = delete;
  Point& operator=(const Point&) = delete;
  ~Point() { gts_object_destroy(GTS_OBJECT(it_)); }
  operator GtsPoint*() const { return it_; }

 private:
  GtsPoint* it_;
};

int said(bool yes, nearmiss_answer* answer) {
  answer->yes = yes, answer->given = 0;
  return NEARMISS_ANSWERED;
}
int segment_triangle_overlap(const double* in, std::size_t, nearmiss_answer* answer) {
  const Segment s(in);
  const Triangle t(in + 6);
  GtsPoint* met = gts_segment_triangle_intersection(s, t, TRUE, gts_point_class());
  const bool yes = met != nullptr;
  // Where an end lies on the triangle, the point is one of the segment's own.
  if (yes && !GTS_IS_VERTEX(met)) gts_object_destroy(GTS_OBJECT(met));
  return said(yes, answer);
}
int aabox_triangle_overlap(const double* in, std::size_t, nearmiss_answer* answer) {
  GtsBBox* box = gts_bbox_new(gts_bbox_class(), nullptr, in[0], in[1], in[2], in[3], in[4], in[5]);
  const bool yes = gts_bbox_overlaps_triangle(box, Triangle(in + 6));
  gts_object_destroy(GTS_OBJECT(box));
  return said(yes, answer);
}
int sphere_segment_overlap(const double* in, std::size_t, nearmiss_answer* answer) {
  return said(gts_point_segment_distance(Point(in), Segment(in + 4)) <= in[3], answer);
}
int sphere_triangle_overlap(const double* in, std::size_t, nearmiss_answer* answer) {
  return said(gts_point_triangle_distance(Point(in), Triangle(in + 4)) <= in[3], answer);
}
void write(const GtsPoint* p, double* to) { to[0] = p->x, to[1] = p->y, to[2] = p->z; }
int point_segment_signed_distance(const double* in, std::size_t, nearmiss_answer* answer) {
  const Point p(in), closest(in);
  const Segment s(in + 3);
  answer->yes = 1, answer->given = 0b1110000001;  // the distance and the second point
  answer->values[0] = gts_point_segment_distance(p, s);
  gts_point_segment_closest(p, s, closest);
  write(closest, answer->values + 7);
  return NEARMISS_ANSWERED;
}
int closest_point_segment(const double* in, std::size_t, nearmiss_answer* answer) {
  const Point closest(in + 6);
  gts_point_segment_closest(Point(in + 6), Segment(in), closest);
  answer->yes = 1;
  write(closest, answer->values);
  return NEARMISS_ANSWERED;
}

const nearmiss_offer offers[] = {
    {"segment_triangle_overlap", 15, 0, nullptr, nullptr, segment_triangle_overlap, 0},
    {"aabox_triangle_overlap", 15, 0, nullptr, nullptr, aabox_triangle_overlap, 0},
    {"sphere_segment_overlap", 10, 0, "gts_point_segment_distance", nullptr, sphere_segment_overlap, 0},
    {"sphere_triangle_overlap", 13, 0, "gts_point_triangle_distance", nullptr, sphere_triangle_overlap, 0},
    {"closest_point_segment", 9, 3, nullptr, nullptr, closest_point_segment, 0},
    {"point_segment_signed_distance", 9, 10, nullptr, nullptr, point_segment_signed_distance, 0},
};
const nearmiss_plugin gts = {NEARMISS_PLUGIN_VERSION,        SUBJECT, "GTS 0.7.6", NEARMISS_DOUBLE,
                             sizeof offers / sizeof *offers, offers};

static_assert(GTS_MAJOR_VERSION == 0 && GTS_MINOR_VERSION == 7 && GTS_MICRO_VERSION == 6);

}  // namespace

extern "C" const nearmiss_plugin* nearmiss_plugin_entry(void) { return &gts; }
