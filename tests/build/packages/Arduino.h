// Of Arduino's core what a sketch meets: its macros, and what DescribePatch calls.
#pragma once
#include <math.h>

#define abs(x) ((x) > 0 ? (x) : -(x))
#define round(x) ((x) >= 0 ? (long)((x) + 0.5) : (long)((x)-0.5))
#define min(a, b) ((a) < (b) ? (a) : (b))
#define max(a, b) ((a) > (b) ? (a) : (b))
#define radians(deg) ((deg)*DEG_TO_RAD)

struct SerialPort {
  void begin(unsigned long baud);
  void print(const char* text);
  void print(char text);
  void print(double value, int digits);
  void println(unsigned long value);
  void println();
};
extern SerialPort Serial;
unsigned long micros();
void delay(unsigned long time_ms);
void setup();
void loop();
