#!/usr/bin/env bash
# Writes a closed bar of quads as OFF: 1 wide, 1 deep, 5 tall, standing on the origin's plane.
#   examples/make_bar.sh > bar.off
set -euo pipefail
awk '
function node(i, j, k,  key) {
  key = i "," j "," k
  if (!(key in number)) {
    number[key] = points++
    position[number[key]] = sprintf("%.9g %.9g %.9g", i / across, j / across, k / across)
  }
  return number[key]
}
function quad(a, b, c, d) { face[faces++] = "4 " a " " b " " c " " d }
BEGIN {
  across = 8; tall = 5 * across
  for (i = 0; i < across; ++i)
    for (j = 0; j < across; ++j) {
      quad(node(i, 0, j), node(i + 1, 0, j), node(i + 1, 0, j + 1), node(i, 0, j + 1))
      quad(node(i, tall, j), node(i, tall, j + 1), node(i + 1, tall, j + 1), node(i + 1, tall, j))
    }
  for (i = 0; i < across; ++i)
    for (j = 0; j < tall; ++j) {
      quad(node(i, j, 0), node(i, j + 1, 0), node(i + 1, j + 1, 0), node(i + 1, j, 0))
      quad(node(i, j, across), node(i + 1, j, across), node(i + 1, j + 1, across), node(i, j + 1, across))
      quad(node(0, j, i), node(0, j, i + 1), node(0, j + 1, i + 1), node(0, j + 1, i))
      quad(node(across, j, i), node(across, j + 1, i), node(across, j + 1, i + 1), node(across, j, i + 1))
    }
  print "OFF"
  print points, faces, 0
  for (i = 0; i < points; ++i) print position[i]
  for (i = 0; i < faces; ++i) print face[i]
}'
