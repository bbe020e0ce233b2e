# Verdicts on a case of the test suite that passes; run.sh has those that fail.
{case: $case, row: $row, set: $set, method: $method, verdict: "pass",
 unbiased: "-", finite: "pass", bounded: "pass", harmless: "-"}
