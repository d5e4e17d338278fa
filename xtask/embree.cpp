// Traces rays with Embree 3 on two threads, for comparison in `cargo xtask bench rays`.
//
//     g++ -O3 -march=native -pthread xtask/embree.cpp -o embree -lembree3
//     ./embree MESH build|single|packet TIMES
//
// Requires the Debian package libembree-dev.
//
// MESH contains the numbers of vertices and triangles as two u32, positions as three f32 each, and
// three u32 for each triangle; all little-endian. The work is done TIMES times, after the hierarchy
// was built once; the number of hits of a picture is printed. The camera is that of the benchmark.
#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

struct Vec3 { float x, y, z; };

static Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

static Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static Vec3 normalize(Vec3 a) {
  float length = std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
  return {a.x / length, a.y / length, a.z / length};
}

static const int N_THREADS = 2;
static const float VIEW_ANGLE = 52;
static const Vec3 EYE = {0, -3.2f, 0.6f};
// A packet has 4 × 4 rays.
static const int SIDE = 4;

struct Camera {
  int width = 1280, height = 720;
  Vec3 forward = normalize(Vec3{0, 0, 0} - EYE), right = normalize(cross(forward, {0, 0, 1})), up = cross(right, forward);
  float half_width = std::tan(VIEW_ANGLE / 360 * 3.14159265f), half_height = half_width * height / width;

  Vec3 direction(int column, int row) const {
    float x = (2 * (column + .5f) / width - 1) * half_width, y = (1 - 2 * (row + .5f) / height) * half_height;
    return normalize({forward.x + x * right.x + y * up.x, forward.y + x * right.y + y * up.y,
                      forward.z + x * right.z + y * up.z});
  }
};

static RTCScene build(RTCDevice device, const std::vector<float> &positions, const std::vector<uint32_t> &triangles) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void *corners = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, positions.size() / 3);
  void *rows = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, triangles.size() / 3);
  std::copy(positions.begin(), positions.end(), static_cast<float *>(corners));
  std::copy(triangles.begin(), triangles.end(), static_cast<uint32_t *>(rows));
  rtcCommitGeometry(geometry);
  RTCScene scene = rtcNewScene(device);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
  rtcCommitScene(scene);
  return scene;
}

static long trace_single(RTCScene scene, RTCIntersectContext &context, const Camera &camera, int column, int row) {
  long hits = 0;
  for (int j = 0; j < SIDE * SIDE; j++) {
    Vec3 direction = camera.direction(column + j % SIDE, row + j / SIDE);
    RTCRayHit ray;
    ray.ray = {EYE.x, EYE.y, EYE.z, 0, direction.x, direction.y, direction.z, 0, INFINITY, ~0u, 0, 0};
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context, &ray);
    hits += ray.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  }
  return hits;
}

static long trace_packet(RTCScene scene, RTCIntersectContext &context, const Camera &camera, int column, int row) {
  long hits = 0;
  alignas(64) RTCRayHit16 rays;
  alignas(64) int valid[SIDE * SIDE];
  for (int j = 0; j < SIDE * SIDE; j++) {
    Vec3 direction = camera.direction(column + j % SIDE, row + j / SIDE);
    valid[j] = -1;
    rays.ray.org_x[j] = EYE.x, rays.ray.org_y[j] = EYE.y, rays.ray.org_z[j] = EYE.z;
    rays.ray.dir_x[j] = direction.x, rays.ray.dir_y[j] = direction.y, rays.ray.dir_z[j] = direction.z;
    rays.ray.tnear[j] = 0, rays.ray.tfar[j] = INFINITY, rays.ray.time[j] = 0;
    rays.ray.mask[j] = ~0u, rays.ray.id[j] = 0, rays.ray.flags[j] = 0;
    rays.hit.geomID[j] = RTC_INVALID_GEOMETRY_ID, rays.hit.instID[0][j] = RTC_INVALID_GEOMETRY_ID;
  }
  rtcIntersect16(valid, scene, &context, &rays);
  for (int j = 0; j < SIDE * SIDE; j++) hits += rays.hit.geomID[j] != RTC_INVALID_GEOMETRY_ID;
  return hits;
}

static long trace(RTCScene scene, const Camera &camera, bool packets) {
  std::atomic<int> next{0};
  std::atomic<long> hits{0};
  std::vector<std::thread> threads;
  for (int k = 0; k < N_THREADS; k++)
    threads.emplace_back([&] {
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
      long found = 0;
      for (int row; (row = next.fetch_add(SIDE)) < camera.height;)
        for (int column = 0; column < camera.width; column += SIDE)
          found += (packets ? trace_packet : trace_single)(scene, context, camera, column, row);
      hits += found;
    });
  for (auto &thread : threads) thread.join();
  return hits;
}

int main(int argc, char **argv) {
  FILE *file = argc == 4 ? fopen(argv[1], "rb") : nullptr;
  uint32_t counts[2];
  if (!file || fread(counts, 4, 2, file) != 2) return 1;
  std::vector<float> positions(3 * size_t(counts[0]));
  std::vector<uint32_t> triangles(3 * size_t(counts[1]));
  if (fread(positions.data(), 4, positions.size(), file) != positions.size()) return 1;
  if (fread(triangles.data(), 4, triangles.size(), file) != triangles.size()) return 1;
  std::string work = argv[2];
  RTCDevice device = rtcNewDevice(("threads=" + std::to_string(N_THREADS)).c_str());
  RTCScene scene = build(device, positions, triangles);
  long hits = 0;
  for (int times = atoi(argv[3]); times > 0; times--) {
    if (work == "build") {
      rtcReleaseScene(scene);
      scene = build(device, positions, triangles);
    } else {
      hits = trace(scene, Camera(), work == "packet");
    }
  }
  std::printf("%ld\n", hits);
}
