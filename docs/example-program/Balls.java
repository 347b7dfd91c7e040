// A collision library in Java as a subject of Nearmiss, over pipes in binary; docs/reference/protocol.md explains each line.
//
//     javac -d build/balls docs/example-program/Balls.java
//     ./nearmiss run --command "java -cp build/balls Balls" --subject balls-java
import java.io.EOFException;
import java.io.FileInputStream;
import java.io.FileOutputStream;
import java.io.IOException;
import java.io.InputStream;
import java.io.OutputStream;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.nio.charset.StandardCharsets;
import java.util.function.Function;

public class Balls {
  static final String HELLO =
      "{\"nearmiss\": 3, \"name\": \"balls-java\", \"version\": \"1.0\", \"scalar\": \"double\", \"batches\": \"binary\", "
          + "\"offers\": [{\"query\": \"sphere_sphere_overlap\"}, "
          + "{\"query\": \"moving_point_sphere\", \"gives\": [\"time\", \"location\"]}]}\n";

  record Answer(boolean yes, double[] values, String cannot) {}

  record Offer(Function<double[], Answer> answer, long given) {}

  /** The function of each offer, and a bit for each value that it gives. */
  static final Offer[] OFFERS = {new Offer(Balls::ballsMeet, 0), new Offer(Balls::rayMeetsBall, 0b1111)};

  static double[] minus(double[] q, int i, int j) {
    return new double[] {q[i] - q[j], q[i + 1] - q[j + 1], q[i + 2] - q[j + 2]};
  }

  static double dot(double[] a, double[] b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }

  static Answer ballsMeet(double[] q) {
    double[] d = minus(q, 0, 4);
    double reach = q[3] + q[7];
    return new Answer(dot(d, d) <= reach * reach, new double[0], "");
  }

  /** The outputs are time, location and normal; the hello says that the normal is not given. */
  static Answer rayMeetsBall(double[] q) {
    double[] v = {q[3], q[4], q[5]}, w = minus(q, 0, 6);
    double a = dot(v, v), b = dot(w, v), c = dot(w, w) - q[9] * q[9];
    if (c < 0 || a == 0) return new Answer(false, new double[0], "it starts inside, or does not move");
    if (b >= 0 || b * b < a * c) return new Answer(false, new double[7], "");
    double t = c / (Math.sqrt(b * b - a * c) - b);
    return new Answer(true, new double[] {t, q[0] + v[0] * t, q[1] + v[1] * t, q[2] + v[2] * t, 0, 0, 0}, "");
  }

  static ByteBuffer read(InputStream from, int bytes) throws IOException {
    byte[] all = from.readNBytes(bytes);
    if (all.length < bytes) throw new EOFException("a batch ends too early");
    return ByteBuffer.wrap(all).order(ByteOrder.nativeOrder());
  }

  static void write(OutputStream to, Answer a, int number, long given) throws IOException {
    byte[] why = a.cannot().getBytes(StandardCharsets.UTF_8);
    ByteBuffer all = ByteBuffer.allocate(16 + 8 * a.values().length + why.length).order(ByteOrder.nativeOrder());
    all.put((byte) (why.length > 0 ? 1 : 0)).put((byte) (a.yes() ? 1 : 0)).putShort((short) why.length);
    all.putInt(number).putLong(given);
    for (double x : a.values()) all.putDouble(x);
    to.write(all.put(why).array());
  }

  /** False at the end of the cases. */
  static boolean answerBatch(InputStream cases, OutputStream answers) throws IOException {
    byte[] first = cases.readNBytes(16);
    if (first.length == 0) return false;
    ByteBuffer head = ByteBuffer.wrap(first).order(ByteOrder.nativeOrder());
    Offer offer = OFFERS[head.getInt()];
    int count = head.getInt(), number = head.getInt(), numbers = head.getInt();
    ByteBuffer lengths = read(cases, 4 * count), all = read(cases, 8 * numbers);
    for (int i = 0; i < count; ++i) {
      double[] q = new double[lengths.getInt()];
      for (int k = 0; k < q.length; ++k) q[k] = all.getDouble();
      write(answers, offer.answer().apply(q), number + i, offer.given());
    }
    answers.flush();
    return true;
  }

  public static void main(String[] words) throws IOException {
    try (InputStream cases = new java.io.BufferedInputStream(new FileInputStream("/dev/fd/3"), 1 << 16);
        OutputStream answers = new java.io.BufferedOutputStream(new FileOutputStream("/dev/fd/4"), 1 << 16)) {
      answers.write(HELLO.getBytes(StandardCharsets.UTF_8));
      answers.flush();
      while (answerBatch(cases, answers)) {}
    }
  }
}
