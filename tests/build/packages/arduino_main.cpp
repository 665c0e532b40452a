// A board that has a terminal in place of its serial port, and stops after the first loop().
#include <cstdio>

#include "Arduino.h"

SerialPort Serial;
void SerialPort::begin(unsigned long) {}
void SerialPort::print(const char* text) { std::fputs(text, stdout); }
void SerialPort::print(char text) { std::putchar(text); }
void SerialPort::print(double value, int digits) { std::printf("%.*f", digits, value); }
void SerialPort::println(unsigned long value) { std::printf("%lu\n", value); }
void SerialPort::println() { std::putchar('\n'); }
unsigned long micros() { return 0; }
void delay(unsigned long) {}

int main() {
  setup();
  loop();
}
