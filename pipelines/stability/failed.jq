# Verdict on a method that failed, with the reason.
{case: $case, row: $row, set: $set, method: $method, verdict: $failed,
 unbiased: "-", finite: "-", bounded: $failed, harmless: "-"}
