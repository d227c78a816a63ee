#include "tests/support/malformed_files.h"

namespace supple {
namespace {

std::string pcd(const std::string& points, const std::string& data, const std::string& body) {
  return "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + points +
         "\nHEIGHT 1\nPOINTS " + points + "\nDATA " + data + "\n" + body;
}

TEST(MalformedPoints, XyzIsRefusedWithAMessage) {
  expect_refused({
      {"a.xyz", "", "cannot read: the file is empty"},
      {"a.xyz", "\n# x y z\nno points here\n", ": the file has no vertices"},
      {"a.xyz", "0 0 0\n0 nan 0\n", ":2: point 1: \"nan\" is not a finite number"},
      {"a.xyz", "nan nan nan\n", ":1: point 0: \"nan\" is not a finite number"},
      {"a.xyz", "0 0 -inf\n", ":1: point 0: \"-inf\" is not a finite number"},
      {"a.xyz", "0 0 1e400\n", ":1: point 0: \"1e400\" is not a finite number"},
      {"a.xyz", "0 0 0\n0 0\n", ":2: point 1: the line has 2 numbers, those before have 3"},
      {"a.xyz", "0 0 0\n0 0 0 0\n", ":2: point 1: the line has 4 numbers"},
      {"a.xyz", "0 0\n", ":1: point 0: the line has 2 numbers; 3, 6 or 9"},
      {"a.xyz", "0 0 0 1 1\n", ":1: point 0: the line has 5 numbers; 3, 6 or 9"},
      {"a.xyz", "1.5\n0 0 0\n", ":1: point 0: one number; a point has at least 3"},
      {"a.xyz", "1,5 2,5 3,5\n", "separated in different ways; decimals need a point"},
      {"a.xyz", "1,5;2,5;3,5\n", "separated in different ways"},
      {"a.xyz", "1,,3\n", ":1: point 0: a number is missing between two separators"},
      {"a.xyz", "1,2,3\n4,5,6\n7,8,9x\n", ":3: point 2: \"9x\" is not a number"},
      {"a.xyz", "0.1x 0 0\n", ":1: point 0: \"0.1x\" is not a number"},
      {"a.xyz", "3\n0 0 0\n1 1 1\n", "the first line says 3 points, the file has 2: it is cut"},
      {"a.xyz", "1\n0 0 0\n1 1 1\n", "the first line says 1 points, the file has 2"},
      {"a.xyz", "3\nwater\nO 0 0 0\nH 1 0 0\nH 0 1 0\n", ":3: point 0: \"O\" is not a number"},
      {"a.xyz", "4000000000\n0 0 0\n", ":1: point 0: one number"},
      {"a.xyz", "x y z r g b\n0 0 0 300 0 0\n", "is outside [0, 1] and [0, 255]"},
      {"a.xyz", std::string("0 0 0\n\0", 7), ": byte 6 is zero: this is not a text file"},
  });
}

TEST(MalformedPoints, PwnIsRefusedWithAMessage) {
  expect_refused({
      {"a.pwn", "", "cannot read: the file is empty"},
      {"a.pwn", "\n\n", "the file is cut short"},
      {"a.pwn", "0\n", ":1: the file has no points"},
      {"a.pwn", "0 0 0\n0 0 1\n", ":1: the line has 3 numbers; allowed: 6, or 3 behind"},
      {"a.pwn", "1\n0 0 0 0\n     ", ":2: point 0: the line has 4 numbers"},
      {"a.pwn", "3000000000\n0 0 0 0 0 1\n", ":1: 3000000000 points cannot be in a file of"},
      {"a.pwn", "-1\n0 0 0 0 0 1\n", ":1: -1 points cannot"},
      {"a.pwn", "2\n0 0 0 0 0 1\n             \n",
       "cut short: the first line says 2 points, it has 1"},
      {"a.pwn", "1\n0 0 0 0 0 1\n1 0 0 0 0 1\n", ":3: point 1: the first line says 1 points"},
      {"a.pwn", "0 0 0 0 0 1\n1 0 0 0 0\n", ":2: point 1: the line ends too early"},
      {"a.pwn", "0 0 0 0 0 1 1\n", ":1: the line has 7 numbers"},
      {"a.pwn", "0 0 0 0 0 nan\n", ":1: point 0: \"nan\" is not a finite number"},
      {"a.pwn", "2\n0 0 0\n1 0 0\n0 0 1\n       \n", ":5: normal 1: the file is cut short"},
      {"a.pwn", "1\n0 0 0\n0 0 1\n0 0 1\n", ":4: more than 1 points"},
      {"a.pwn", "2\n0 0 0\n1 0 inf\n0 0 1\n0 0 1\n", ":3: point 1: \"inf\" is not a finite"},
  });
}

TEST(MalformedPoints, PcdIsRefusedWithAMessage) {
  const std::string fields = "FIELDS x y z\n", sizes = "SIZE 4 4 4\n", types = "TYPE F F F\n";
  const std::string infinite("\0\0\0\0\0\0\0\0\0\0\x80\x7f", 12);
  const std::string zeros(12, '\0');
  const auto packed = [](std::uint32_t packed, std::uint32_t unpacked, const std::string& bytes) {
    std::string body(8, '\0');
    for (int k = 0; k < 4; ++k) {
      body[k] = static_cast<char>(packed >> (8 * k));
      body[4 + k] = static_cast<char>(unpacked >> (8 * k));
    }
    return body + bytes;
  };
  expect_refused({
      {"a.pcd", "", "cannot read: the file is empty"},
      {"a.pcd", "ply\n", ":1: \"ply\" is no entry of a PCD header"},
      {"a.pcd", fields, ":1: the file is cut short"},
      {"a.pcd", "DATA ascii\n", ":1: the header has no FIELDS"},
      {"a.pcd", fields + "DATA ascii\n", "SIZE has 0 entries for 3 fields"},
      {"a.pcd", fields + sizes + "TYPE F F\nDATA ascii\n", "TYPE has 2 entries for 3 fields"},
      {"a.pcd", fields + sizes + types + "COUNT 1\nDATA ascii\n", "COUNT has 1 entries"},
      {"a.pcd", fields + "SIZE 4 4 3\n" + types + "DATA ascii\n", "SIZE 3 with TYPE F"},
      {"a.pcd", fields + sizes + "TYPE F F X\nDATA ascii\n", "SIZE 4 with TYPE X"},
      {"a.pcd", fields + sizes + types + "COUNT 1 1 0\nDATA ascii\n", "COUNT 0: must be 1 to"},
      {"a.pcd", fields + sizes + types + "COUNT 1 1 1e99\nDATA ascii\n", "must be 1 to"},
      {"a.pcd", fields + sizes + types + "DATA ascii\n", "neither POINTS nor WIDTH"},
      {"a.pcd", fields + sizes + types + "DATA text\n", "the data are not ascii, binary or"},
      {"a.pcd", fields + sizes + types + "POINTS 7\nWIDTH 2\nHEIGHT 3\nDATA ascii\n",
       "POINTS 7 is not WIDTH 2 times HEIGHT 3"},
      {"a.pcd", "FIELDS x y w\n" + sizes + types + "POINTS 1\nDATA ascii\n0 0 0\n",
       "the points have no fields x, y and z"},
      {"a.pcd", pcd("0", "ascii", "\n"), "the file has no points"},
      {"a.pcd", pcd("-1", "ascii", "\n"), "-1 points"},
      {"a.pcd", pcd("4000000000", "binary", zeros), "4000000000 points"},
      {"a.pcd", pcd("2000000000", "binary", zeros),
       "cut short: 2000000000 points need at least 12"},
      {"a.pcd", pcd("2000000000", "ascii", "0 0 0\n"), "2000000000 points need at least 6 bytes"},
      {"a.pcd", pcd("1", "ascii", "0 0 inf\n"), ":10: point 0: \"inf\" is not a finite number"},
      {"a.pcd", pcd("1", "ascii", "0 0 1 1\n"), "\"1\" is more than belongs on this line"},
      {"a.pcd", pcd("2", "ascii", "0 0 0\n      \n"), ":11: point 1: the file is cut short"},
      {"a.pcd", pcd("1", "ascii", "nan nan nan\n"), ": the file has no vertices"},
      {"a.pcd", pcd("1", "binary", infinite), ": point 0: z is not a finite number"},
      {"a.pcd", pcd("1", "binary_compressed", "abc"), ":9: the file is cut short"},
      {"a.pcd", pcd("1", "binary_compressed", packed(99, 12, zeros)),
       "99 packed bytes are promised"},
      {"a.pcd", pcd("1", "binary_compressed", packed(4, 8, zeros)),
       "1 points need 12 bytes, 8 are"},
      {"a.pcd", pcd("300000000", "binary_compressed", packed(12, 3600000000u, zeros)), "damaged"},
      {"a.pcd", pcd("1", "binary_compressed", packed(2, 12, "\x20\x05")), "damaged"},
      {"a.pcd",
       fields + sizes + types + "WIDTH 1073741824\nHEIGHT 1073741824\nDATA binary_compressed\n" +
           packed(0, 0, ""),
       "1152921504606846976 points"},
      {"a.pcd", pcd("1", "binary_compressed", packed(1, 12, "\x05")), "damaged"},
  });
}

}  // namespace
}  // namespace supple
