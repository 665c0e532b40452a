// Describes the patch around one point of a wavy sheet, again and again, and prints how long that takes. Put your sensor's
// points, in meters, in the sheet's place.
#include <shortshot.h>

using Descriptor = shortshot::Ssh96;
const int side = 20;
static float xyz[side * side][3];
static shortshot::Workspace<side * side> workspace;  // all scratch memory: 20 bytes a neighbor
static float row[Descriptor::size];

void setup() {
  Serial.begin(115200);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      float* const point = xyz[y * side + x];
      point[0] = 0.004f * x;
      point[1] = 0.004f * y;
      point[2] = 0.5f + 0.0001f * x * y + 0.0002f * y * y;
    }
  }
}

void loop() {
  const auto cloud = shortshot::view_xyz(xyz[0], side * side);
  const shortshot::BruteSearch search{cloud};
  const unsigned long start = micros();
  const auto status = shortshot::describe_at<Descriptor>(cloud, search, side * side / 2 + side / 2, 0.03f, workspace, row);
  const unsigned long time_us = micros() - start;
  Serial.print(shortshot::message(status));
  Serial.print(", microseconds: ");
  Serial.println(time_us);
  for (const float value : row) {
    Serial.print(value, 4);
    Serial.print(' ');
  }
  Serial.println();
  delay(1000);
}
