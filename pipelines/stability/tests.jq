# Verdicts on a case of the test suite.
(if $failed == "" then "pass" else $failed end) as $verdict
| {case: $case, row: $row, set: $set, method: $method, verdict: $verdict, cell: $verdict,
   unbiased: "-", finite: $verdict, bounded: $verdict, harmless: "-"}
