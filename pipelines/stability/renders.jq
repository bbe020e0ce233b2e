# Verdicts on one method in one case, from what renders.sh measured: $of and $base (the same of mode
# bsdf) hold the comparison by tiles, that of the whole image, and the statistics of the reference
# and of each seed. A verdict is "pass", "-" where there is nothing to judge, or what is wrong.

# The largest count that chance leaves unsurprising: more come up once in 10^4 cases.
def most_by_chance($n; $p):
  {k: 0, mass: pow(1 - $p; $n), left: (1 - pow(1 - $p; $n))}
  | until(.left < 1e-4 or .k >= $n;
      .mass *= ($n - .k) / (.k + 1) * $p / (1 - $p) | .k += 1 | .left -= .mass)
  | .k;

def mean: add / length;
def squared_error_of_mean: mean as $m | map(. - $m | . * .) | add / length / ([length - 1, 1] | max);
def digits($n): . * pow(10; $n) | round / pow(10; $n);

# The reference's own noise is part of each relMSE.
def error_of($m): $m[0].relmse_of_each as $each | $m[2].estimated_relmse as $noise
  | {mean: ([($each | mean) - $noise, 0] | max), variance: ($each | squared_error_of_mean)};
def cost_of($m): error_of($m) as $e | ($m[3:] | map(.cpu_seconds)) as $t
  | {mean: ($e.mean * ($t | mean)),
     relative: (if $e.mean > 0 then $e.variance / ($e.mean * $e.mean)
                + ($t | squared_error_of_mean) / pow($t | mean; 2) else 0 end)};
def harm($m; $b): cost_of($m) as $c | cost_of($b) as $d
  | if $d.mean > 0 and $c.mean > 0
    then {ratio: ($c.mean / $d.mean), error: (($c.mean / $d.mean) * ($c.relative + $d.relative | sqrt))}
    else null end;

# Three colours of a tile may go together, so chance is that of as many tiles.
def unbiased($m): $m[0].z.tiles as $t | $m[1].z.tiles as $image
  | (3 * most_by_chance($t.count / 3 | floor; 0.0027)) as $allowed
  | if $t.unexplained > 0 then "\($t.unexplained) scores without noise"
    elif $t.beyond3 > $allowed then "\($t.beyond3) of \($t.count) > 3σ"
    elif $image.largest > 4 then "image \($image.largest | digits(1))σ"
    elif ($m[0].mean_ratio // 1 | . - 1 | fabs) > 1e-4 and $image.count == 0 then "image differs"
    else "pass" end;
def finite($m): ($m[2:] | map(.invalid_samples) | add) as $invalid
  | if $m[0].non_finite > 0 then "\($m[0].non_finite) pixels not finite"
    elif $invalid > 0 then "\($invalid) samples not finite" else "pass" end;
def worst($m; key): $m[3:] | map(key) | max;
# Edges of a path and of each of its copies.
def edges: .mean_path_length / (1 + .copies_per_path);
def bounded($m):
  if worst($m; edges) > $longest then "paths of \(worst($m; edges) | digits(1)) edges"
    elif worst($m; .copies_per_path) > 64 then "\(worst($m; .copies_per_path) | digits(1)) copies"
  elif worst($m; .peak_memory_bytes) > 5e8 then "\(worst($m; .peak_memory_bytes) / 1e6 | round) MB"
  else "pass" end;
def harmless($h): if $h == null then "-"
  elif ($h.ratio / 1.05 | log) > 3 * $h.error / $h.ratio
    then "×\($h.ratio | digits(2)) ± \($h.error | digits(2))"
  else "pass" end;

$of[0] as $m | $base[0] as $b
| (if $timed == 0 or $b == null or $method == "bsdf" then null else harm($m; $b) end) as $h
| (if $timed == 0 then null else cost_of($m) end) as $cost
| {unbiased: unbiased($m), finite: finite($m), bounded: bounded($m), harmless: harmless($h)}
| {case: $case, row: $row, set: $set, method: $method,
   verdict: ([.finite, .bounded, .unbiased, .harmless] | map(select(. != "pass" and . != "-"))
             | if . == [] then "pass" else join("; ") end)} + .
+ {cost_ratio: ($h.ratio // "" | if . == "" then . else digits(3) end),
   cost_error: ($h.error // "" | if . == "" then . else digits(3) end),
   cost: $cost.mean, cost_variance: $cost.relative,
   tiles: $m[0].z.tiles.count, beyond3: $m[0].z.tiles.beyond3,
   allowed3: (3 * most_by_chance($m[0].z.tiles.count / 3 | floor; 0.0027)),
   image_z: ($m[1].z.tiles.largest | digits(2)), mean_ratio: ($m[0].mean_ratio // 1 | digits(4)),
   relmse: ($m[0].relmse_of_each | mean), invalid: ($m[3:] | map(.invalid_samples) | add),
   path_length: (worst($m; .mean_path_length) | digits(2)),
   copies: (worst($m; .copies_per_path) | digits(3)),
   memory_mb: (worst($m; .peak_memory_bytes) / 1e6 | round),
   cpu_seconds: ($m[3:] | map(.cpu_seconds) | mean)}
